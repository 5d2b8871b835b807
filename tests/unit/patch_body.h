#ifndef morsel_tests_patch_body_h
#define morsel_tests_patch_body_h

#include <morsel/sph/conforming_weights.h>
#include <morsel/sph/leapfrog.h>
#include <morsel/sph/pair_kernels.h>
#include <morsel/sph/pair_loops.h>

#include <cmath>
#include <random>

namespace Morsel::SPH
{
  /// Particles with their bonds and the two pair loops, without a host, a
  /// scene or a step: what the tests of the discrete operators work on.
  struct PatchBody
  {
    /// A lattice of @p nx times @p ny, its particles thrown off their places
    /// by up to @p scatter spacings.
    PatchBody(const unsigned int nx,
              const unsigned int ny,
              const bool         linear_law,
              const double       scatter    = 0.,
              const KernelKind   kind       = KernelKind::cubic_b_spline,
              const double       ratio      = 1.3,
              const double       hourglass  = 0.5,
              const bool         conforming = false)
        : kernel(kind, ratio * spacing)
        , material(23.9e6, 0.3, 1088.)
        , linear_law(linear_law)
    {
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> uniform(-scatter, scatter);
      for (unsigned int y = 0; y < ny; ++y)
        for (unsigned int x = 0; x < nx; ++x)
          {
            const double a = scatter > 0. ? uniform(generator) : 0.;
            const double b = scatter > 0. ? uniform(generator) : 0.;
            add({(x + a) * spacing, (y + b) * spacing});
          }
      if (conforming)
        fill_cells(nx, ny);
      hourglass_stiffness = hourglass * material.youngs_modulus;
      complete();
    }

    void
    add(const dealii::Point<2> &x)
    {
      p.id.push_back(p.reference.size());
      p.reference.push_back(x);
    }

    /// Everything that follows from the reference positions.
    void
    complete()
    {
      const unsigned int n = p.reference.size();
      p.n_owned = p.n_local = n;
      p.spacing             = spacing;
      std::vector<double> areas(n, spacing * spacing);
      if (is_conforming())
        for (unsigned int i = 0; i < n; ++i)
          areas[i] = cloud.cells[i].area;
      p.set_areas(areas, depth, material.density);
      p.motion.assign(n, {0., 0., 0., 0.});
      p.half_velocity.assign(n, {0., 0.});
      p.acceleration.assign(n, {0., 0.});
      p.gradient.assign(n, {0., 0., 0., 0.});
      p.pair_stress.assign(n, {0., 0., 0., 0.});
      p.hourglass.assign(n, hourglass_stiffness);
      p.viscous.assign(n, {0., 0.});
      p.viscous_heat.assign(n, 0.);
      p.damage.assign(n, 0.);
      p.failed.assign(n, 0);
      p.effective.assign(n, {0., 0., 0., 0.});
      p.shape.assign(n, {0., 0., 0.});
      p.near_face.assign(n, 0);
      p.driver.assign(n, 0.);
      p.crushed.assign(p.n_groups(), 0);
      p.strongest.assign(p.n_groups(), 0.);
      p.fit_stress.assign(n, {0., 0., 0., 0.});
      if (is_conforming())
        {
          bonds.build_conforming(p, {cloud, kernel}, kernel);
          p.deficit.resize(n);
          p.fit.resize(n);
          p.own_sum.resize(n);
        }
      else
        bonds.build(p, kernel, {}, {true});
      renew();
    }

    /// What follows from the uncut bonds.
    void
    renew()
    {
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (is_conforming())
          renew_conforming(p, bonds, i);
        else if (bonds.list.start[i + 1] > bonds.list.start[i])
          p.shape[i] = inverse(bonds.moment(p, i));
    }

    /// Cuts all bonds across the height @p y from the left edge to @p length.
    void
    cut(const double y, const double length)
    {
      bonds.make_breakable(p, kernel);
      for (unsigned int i = 0; i < p.n_owned; ++i)
        for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
             ++k)
          {
            const auto &X = p.reference[i];
            const auto &Y = p.reference[bonds.list.index[k]];
            if (X[1] < y && Y[1] > y && std::max(X[0], Y[0]) < length)
              bonds.cut(k);
          }
      renew();
    }

    bool
    is_conforming() const
    {
      return !cloud.cells.empty();
    }

    /// Voronoi cells in the rectangle half a spacing around a lattice.
    void
    fill_cells(const unsigned int nx, const unsigned int ny)
    {
      cloud.lower   = {-0.5 * spacing, -0.5 * spacing};
      cloud.upper   = {(nx - 0.5) * spacing, (ny - 0.5) * spacing};
      cloud.spacing = spacing;
      cloud.points  = p.reference;
      cloud.cells =
          voronoi_cells(cloud.points, cloud.lower, cloud.upper, cloud.spacing);
    }

    /// u(X) = (H X + shift) for all particles.
    void
    set_linear(const Materials::Tensor2 &H, const double x, const double y)
    {
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const auto &X   = p.reference[i];
          p.motion[i].u_x = H.xx * X[0] + H.xy * X[1] + x;
          p.motion[i].u_y = H.yx * X[0] + H.yy * X[1] + y;
        }
    }

    /// Displacements up to @p size spacings, different for every particle.
    void
    set_random(const double size)
    {
      std::mt19937                           generator(4);
      std::uniform_real_distribution<double> uniform(-size * spacing,
                                                     size * spacing);
      for (Motion &m : p.motion)
        {
          m.u_x = uniform(generator);
          m.u_y = uniform(generator);
        }
    }

    void
    strain(const bool viscosity = false)
    {
      constexpr unsigned int soften_deviator = 1;
      const PairKernels     &kernels         = pair_kernels();
      if (!bonds.lattice.empty())
        kernels.columns[viscosity](
            bonded_arrays(p, bonds), constants(), 0, p.n_groups());
      (is_conforming() ? kernels.strain_conforming
                       : kernels.strain)[linear_law][soften_deviator](
          bonded_arrays(p, bonds), constants(), 0, p.n_groups());
    }

    /// Accelerations at the present displacements.
    void
    accelerate(const bool viscosity = false)
    {
      strain(viscosity);
      p.viscous.assign(p.n_local, {0., 0.});
      const PairKernels &kernels = pair_kernels();
      (is_conforming() ? kernels.force_conforming
                       : kernels.force)[viscosity][true](
          bonded_arrays(p, bonds), constants(), 0, p.n_groups());
    }

    /// Strain and hourglass energy at the present displacements [J].
    double
    energy()
    {
      strain();
      double sum = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (!p.failed[i] && (is_conforming() || p.shape[i].xx > 0.))
          sum += p.volume(i) * Materials::stored_energy(
                                   Materials::Softening::deviator,
                                   material,
                                   response_at(p, material, linear_law, i),
                                   p.damage[i]) +
                 p.hourglass[i] * fit_residual(p, bonds, i);
      return sum;
    }

    double
    kinetic_energy() const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const Motion &m = p.motion[i];
          sum += 0.5 * p.mass[i] * (m.v_x * m.v_x + m.v_y * m.v_y);
        }
      return sum;
    }

    BondedConstants
    constants() const
    {
      BondedConstants c{};
      c.mu                = material.mu;
      c.bulk              = material.bulk;
      c.density           = material.density;
      c.uniform_hourglass = hourglass_stiffness;
      c.viscosity_alpha_c = material.wave_speed;
      c.viscosity_beta    = 2.;
      c.smoothing_length  = kernel.h;
      return c;
    }

    /// The acceleration of a full change of stress over one spacing.
    double
    unit_acceleration() const
    {
      return material.youngs_modulus / (material.density * spacing);
    }

    static constexpr double spacing = 1e-3, depth = 0.01;

    Kernel                kernel;
    Materials::Elasticity material;
    bool                  linear_law;
    double                hourglass_stiffness = 0.;
    Particles             p;
    Bonds                 bonds;
    Cloud                 cloud; ///< with cells where conforming
    Leapfrog              leapfrog;
  };
} // namespace Morsel::SPH

#endif
