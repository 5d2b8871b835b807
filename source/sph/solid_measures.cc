#include <morsel/core/parallel.h>
#include <morsel/sph/solid.h>

#include <atomic>
#include <cmath>

namespace Morsel::SPH
{
  double
  DeformableBody::sum_over_ranks(const double part) const
  {
    return ranks() ? ranks()->sum(part) : part;
  }


  void
  DeformableBody::sum_over_ranks(const dealii::ArrayView<double> &parts) const
  {
    if (ranks())
      ranks()->sum(parts);
  }


  SolidEnergies
  Solid::energies() const
  {
    SolidEnergies e;
    if (energy_loop)
      {
        parallel_for(
            particles.n_groups(),
            [&](unsigned int begin, unsigned int end) {
              if (!bonds.lattice.empty())
                column_loop(arrays, constants, begin, end);
            },
            64);
        bonds.lattice.take_motion_of_ghosts(particles);
        parallel_for(
            particles.n_groups(),
            [&](unsigned int begin, unsigned int end) {
              energy_loop(arrays, constants, begin, end);
            },
            64);
        for (const GroupEnergy &group : particles.energy)
          {
            e.strain += group.strain;
            e.hourglass += group.hourglass;
          }
      }
    for (unsigned int i = 0; !energy_loop && i < particles.n_owned; ++i)
      {
        if (fracture && particles.failed[i])
          continue;
        e.strain += particles.modulus_factor(i) * particles.volume(i) *
                    Materials::stored_energy(
                        softening,
                        material,
                        response_at(particles, material, linear_law, i),
                        fracture ? particles.damage[i] : 0.);
        e.hourglass +=
            particles.hourglass[i] * fit_residual(particles, bonds, i);
      }
    e.kinetic      = kinetic_energy(leapfrog, particles);
    e.viscous_heat = viscous_heat(leapfrog, particles);
    if (fracture)
      {
        e.damage_heat   = particles.sum_of_owned(particles.damage_heat);
        e.bond_heat     = fracture->bond_heat();
        e.granular      = granular->stored_energy();
        e.friction_heat = granular->friction_heat();
      }
    double *const all = &e.strain;
    host.sum(dealii::ArrayView<double>(all, sizeof(e) / sizeof(double)));
    return e;
  }


  Vector2
  Solid::momentum() const
  {
    Vector2 p = half_step_momentum(particles);
    host.sum(dealii::ArrayView<double>(&p.x, 2));
    return p;
  }


  Materials::PlaneStrainStress
  Solid::stress(const unsigned int i) const
  {
    if (fracture && particles.failed[i])
      return granular->stress(i);
    // Softening is homogeneous of degree one.
    const double                       f = particles.modulus_factor(i);
    const Materials::PlaneStrainStress s =
        Materials::soften(softening,
                          response_at(particles, material, linear_law, i),
                          fracture ? particles.damage[i] : 0.);
    return {f * s.xx, f * s.yy, f * s.xy, f * s.zz};
  }


  Materials::Tensor2
  Solid::velocity_gradient(const unsigned int i) const
  {
    const Materials::Tensor2 rate = rate_of_gradient(particles, bonds, i);
    if (linear_law)
      return rate;
    // L = dF/dt F^-1.
    const Materials::Tensor2 &H = particles.gradient[i];
    const double d = 1. / ((1. + H.xx) * (1. + H.yy) - H.xy * H.yx);
    return {d * (rate.xx * (1. + H.yy) - rate.xy * H.yx),
            d * (rate.xy * (1. + H.xx) - rate.xx * H.xy),
            d * (rate.yx * (1. + H.yy) - rate.yy * H.yx),
            d * (rate.yy * (1. + H.xx) - rate.yx * H.xy)};
  }


  std::vector<Vector2>
  Solid::surface_vectors() const
  {
    // S_i = V_i sum_j (V_j/V_i G_ji - G_ij).
    std::vector<Symmetric2> shape = particles.shape;
    if (!host.is_alone())
      host.exchange(shape);
    std::vector<Vector2> S(particles.n_owned, {0., 0.});
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
           ++k)
        {
          const double V = particles.volume(i);
          if (bonds.is_conforming())
            {
              S[i].x += V * (bonds.back[k].x - bonds.own[k].x);
              S[i].y += V * (bonds.back[k].y - bonds.own[k].y);
              continue;
            }
          const Symmetric2 &B = shape[i];
          const Symmetric2 &C = shape[bonds.list.index[k]];
          const auto [X, Y]   = bonds.offset(particles, i, k);
          const double w      = V * bonds.weight[k];
          S[i].x -= w * ((B.xx + C.xx) * X + (B.xy + C.xy) * Y);
          S[i].y -= w * ((B.xy + C.xy) * X + (B.yy + C.yy) * Y);
        }
    return S;
  }


  double
  Solid::neighbours_per_particle() const
  {
    return host.sum(static_cast<double>(bonds.list.start[particles.n_owned])) /
           host.n_global();
  }


  double
  Solid::density_ratio(const unsigned int i) const
  {
    if (fracture && particles.failed[i])
      return granular->density_ratio(i);
    const Materials::Tensor2 &H = particles.gradient[i];
    return 1. / (linear_law ? 1. + H.xx + H.yy
                            : (1. + H.xx) * (1. + H.yy) - H.xy * H.yx);
  }


  unsigned int
  Solid::inverted_count() const
  {
    unsigned int count = 0;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const double ratio = density_ratio(i);
        count += !(ratio > 0.) || !std::isfinite(ratio);
      }
    return count;
  }


  long
  Solid::first_inverted() const
  {
    if (linear_law)
      return -1;
    const char *const failed = fracture ? particles.failed.data() : nullptr;
    const Materials::Tensor2 *const gradient    = particles.gradient.data();
    const auto                      is_inverted = [=](const unsigned int i) {
      const Materials::Tensor2 &H = gradient[i];
      return !((1. + H.xx) * (1. + H.yy) - H.xy * H.yx > 0.) &&
             !(failed && failed[i]);
    };
    std::atomic<bool> found = false;
    parallel_for(
        particles.n_owned,
        [&](const unsigned int begin, const unsigned int end) {
          bool any = false;
          for (unsigned int i = begin; i < end; ++i)
            any |= is_inverted(i);
          if (any)
            found = true;
        },
        2048);
    for (unsigned int i = 0; found && i < particles.n_owned; ++i)
      if (is_inverted(i))
        return i;
    return -1;
  }
} // namespace Morsel::SPH
