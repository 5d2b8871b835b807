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
  Solid::damping_rate() const
  {
    // What has broken is damped even where the intact body is not.
    return viscosity || fracture
               ? viscous_damping_rate(constants.viscosity_alpha_c,
                                      particles.spacing)
               : 0.;
  }


  double
  Solid::stable_time_step(const double contact_stiffness) const
  {
    return stable_time_step(contact_stiffness, 0.);
  }


  double
  Solid::stable_time_step(const double contact_stiffness,
                          const double stopped) const
  {
    // A spring of stiffness k on one particle adds k/m to the square.
    const double w2 =
        highest_frequency + contact_stiffness / least_mass(particles, host);
    const double g    = damping_rate();
    const double step = cfl * largest_stable_step(w2, g);
    if (stopped == 0.)
      return step;
    return std::min(step,
                    std::max(1., cfl) * largest_stable_step(w2, g, stopped));
  }


  void
  Solid::compute_accelerations(const double)
  {
    constexpr unsigned int grain = 64;
    arrays                       = bonded_arrays(particles, bonds);
    if (!viscosity) // what failed material added
      std::fill(particles.viscous.begin(), particles.viscous.end(), Vector2{});

    // Only the first groups have to do with other ranks: the others are worked
    // on while messages are on their way.
    const unsigned int n_boundary =
        (host.n_boundary() + group_size - 1) / group_size;
    const unsigned int n    = particles.n_groups();
    const auto         work = [&](const PairKernels::Strain loop,
                          const unsigned int        first,
                          const unsigned int        last) {
      parallel_for(
          last - first,
          [&](unsigned int begin, unsigned int end) {
            loop(arrays, constants, first + begin, first + end);
          },
          grain);
    };
    if (!bonds.lattice.empty())
      work(column_loop, 0, n);
    work(strain_loop, n_boundary, n);
    finish_motion();
    bonds.lattice.take_motion_of_ghosts(particles);
    work(strain_loop, 0, n_boundary);
    const auto stresses    = dealii::make_array_view(particles.pair_stress);
    const auto stiffnesses = dealii::make_array_view(particles.hourglass);
    const auto fits        = dealii::make_array_view(particles.fit_stress);
    const bool conforming  = bonds.is_conforming();
    host.exchange_start(stresses);
    if (fracture)
      host.exchange_start(stiffnesses, stiffness_channel);
    if (conforming)
      host.exchange_start(fits, fit_channel);
    work(force_loop, n_boundary, n);
    host.exchange_finish(stresses);
    if (fracture)
      host.exchange_finish(stiffnesses, stiffness_channel);
    if (conforming)
      host.exchange_finish(fits, fit_channel);
    bonds.lattice.take_stress_of_ghosts(particles);
    work(force_loop, 0, n_boundary);
  }


  void
  Solid::finish_motion()
  {
    if (motion_travels)
      host.exchange_finish(dealii::make_array_view(particles.motion),
                           motion_channel);
    motion_travels = false;
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
      granular->take_over(failed, fracture->parted_now());
  }


  void
  Solid::advance(const double dt)
  {
    leapfrog.advance(particles, dt);
    host.exchange_start(dealii::make_array_view(particles.motion),
                        motion_channel);
    motion_travels = true;
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


  std::vector<unsigned int>
  Solid::work_of_particles() const
  {
    // Measured, doc/performance.md.
    std::vector<unsigned int> work(particles.n_owned,
                                   bonds.is_conforming() ? 500 : 100);
    if (fracture)
      fracture->add_work(work);
    if (granular && granular->active())
      granular->add_work(work);
    return work;
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
