#include <morsel/core/parallel.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/stable_step.h>

#include <algorithm>
#include <limits>

namespace Morsel::SPH
{
  namespace
  {
    /// Of the whole body: all ranks take the same step. Collective.
    double
    least_mass(const Particles &particles, const ParticleHost<2> &host)
    {
      return host.minimum(particles.mass.empty()
                              ? std::numeric_limits<double>::max()
                              : particles.least_mass());
    }
  } // namespace


  double
  Solid::stable_time_step(const double contact_stiffness) const
  {
    // A spring of stiffness k on one particle adds k/m to the square.
    const double w2 =
        highest_frequency + contact_stiffness / least_mass(particles, host);
    // What has broken is damped even where the intact body is not.
    const double g = viscosity || fracture
                         ? viscous_damping_rate(constants.viscosity_alpha_c,
                                                particles.spacing)
                         : 0.;
    return cfl * largest_stable_step(w2, g);
  }


  void
  Solid::compute_accelerations(const double)
  {
    constexpr unsigned int grain  = 64;
    const BondedArrays     arrays = bonded_arrays(particles, bonds);
    parallel_for(
        particles.n_groups(),
        [&](unsigned int begin, unsigned int end) {
          strain_loop(arrays, constants, begin, end);
        },
        grain);
    if (fracture)
      host.exchange(particles.pair_stress, particles.hourglass);
    else
      host.exchange(particles.pair_stress);
    if (!viscosity) // what failed material added
      std::fill(particles.viscous.begin(), particles.viscous.end(), Vector2{});
    parallel_for(
        particles.n_groups(),
        [&](unsigned int begin, unsigned int end) {
          force_loop(arrays, constants, begin, end);
        },
        grain);
  }


  void
  Solid::add_grain_forces(const double time_step)
  {
    if (granular && granular->active())
      granular->add_forces(time_step);
  }


  void
  Solid::apply_forces(const std::vector<ParticleForce> &forces)
  {
    for (const auto &f : forces)
      {
        Vector2     &a = particles.acceleration[f.particle];
        const double m = particles.mass[f.particle];
        a.x += f.force[0] / m;
        a.y += f.force[1] / m;
      }
  }


  void
  Solid::grow_damage(const double time_step)
  {
    if (!fracture)
      return;
    const std::vector<unsigned int> &failed = fracture->update(time_step);
    if (fracture->any_failed_now())
      granular->take_over(failed);
  }


  void
  Solid::advance(const double dt)
  {
    leapfrog.advance(particles, dt);
    host.exchange(particles.motion);
  }


  void
  Solid::advance_grains(const double dt)
  {
    if (granular && granular->active())
      granular->advance(dt);
  }


  void
  Solid::set_near_face(const std::vector<unsigned int> &near)
  {
    if (!fracture)
      return;
    for (const unsigned int i : near)
      particles.near_face[i] = 1;
  }


  ParticleSide
  Solid::contact_side() const
  {
    return {particles.spacing,
            depth,
            least_mass(particles, host),
            material.youngs_modulus,
            material.p_wave_modulus,
            kernel.h};
  }
} // namespace Morsel::SPH
