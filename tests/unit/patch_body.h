#ifndef morsel_tests_patch_body_h
#define morsel_tests_patch_body_h

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
              const double       scatter   = 0.,
              const KernelKind   kind      = KernelKind::cubic_b_spline,
              const double       ratio     = 1.3,
              const double       hourglass = 0.5)
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
      p.volume              = spacing * spacing * depth;
      p.mass                = material.density * p.volume;
      p.motion.assign(n, {0., 0., 0., 0.});
      p.half_velocity.assign(n, {0., 0.});
      p.acceleration.assign(n, {0., 0.});
      p.gradient.assign(n, {0., 0., 0., 0.});
      p.pair_stress.assign(n, {0., 0., 0., 0.});
      p.hourglass.assign(n, hourglass_stiffness);
      p.viscous_heat.assign(n, 0.);
      p.damage.assign(n, 0.);
      p.failed.assign(n, 0);
      p.effective.assign(n, {0., 0., 0., 0.});
      p.shape.assign(n, {0., 0., 0.});
      p.near_face.assign(n, 0);
      p.driver.assign(n, 0.);
      p.crushed.assign(p.n_groups(), 0);
      p.strongest.assign(p.n_groups(), 0.);
      bonds.build(p, kernel);
      for (unsigned int i = 0; i < n; ++i)
        if (bonds.list.start[i + 1] > bonds.list.start[i])
          p.shape[i] = inverse(bonds.moment(i));
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
    strain()
    {
      constexpr unsigned int soften_deviator = 1;
      pair_kernels().strain[linear_law][soften_deviator](
          bonded_arrays(p, bonds), constants(), 0, p.n_groups());
    }

    /// Accelerations at the present displacements.
    void
    accelerate(const bool viscosity = false, const double time_step = 0.)
    {
      strain();
      pair_kernels().force[viscosity][true](
          bonded_arrays(p, bonds), constants(), time_step, 0, p.n_groups());
    }

    /// Strain and hourglass energy at the present displacements [J].
    double
    energy()
    {
      strain();
      double sum = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (!p.failed[i] && p.shape[i].xx > 0.)
          sum += p.volume * Materials::stored_energy(
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
      for (const Motion &m : p.motion)
        sum += 0.5 * p.mass * (m.v_x * m.v_x + m.v_y * m.v_y);
      return sum;
    }

    /// One kick and drift, as Solid::advance() does it.
    void
    advance(const double dt, const bool first)
    {
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const Vector2 a    = p.acceleration[i];
          const double  kick = first ? 0.5 * dt : dt;
          Vector2      &v    = p.half_velocity[i];
          v.x += kick * a.x;
          v.y += kick * a.y;
          Motion &m = p.motion[i];
          m.u_x += dt * v.x;
          m.u_y += dt * v.y;
          m.v_x = v.x + 0.5 * dt * a.x;
          m.v_y = v.y + 0.5 * dt * a.y;
        }
    }

    BondedConstants
    constants() const
    {
      BondedConstants c{};
      c.mu                = material.mu;
      c.bulk              = material.bulk;
      c.density           = material.density;
      c.mass              = p.mass;
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
  };
} // namespace Morsel::SPH

#endif
