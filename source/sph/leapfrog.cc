#include <morsel/core/parallel.h>
#include <morsel/sph/leapfrog.h>

#include <atomic>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// Of the forces of viscosity at the velocity that the accelerations lead
    /// to [W], not the predicted one: that would book too much of fast motion.
    inline double
    viscous_power(const double   mass,
                  const Vector2 &viscous,
                  const Vector2 &v,
                  const Vector2 &a,
                  const double   lag)
    {
      return -mass *
             (viscous.x * (v.x + lag * a.x) + viscous.y * (v.y + lag * a.y));
    }


    /// Moves particles [begin, end); returns the square of the largest speed
    /// [m^2/s^2].
    /// @param before what the velocities lag behind by [s]
    template <bool viscous>
    double
    move(Particles         &particles,
         const unsigned int begin,
         const unsigned int end,
         const double       before,
         const double       dt)
    {
      const double         kick    = before + 0.5 * dt;
      const Vector2 *const as      = particles.acceleration.data();
      Vector2 *const       vs      = particles.half_velocity.data();
      Motion *const        ms      = particles.motion.data();
      double               fastest = 0.;
      for (unsigned int i = begin; i < end; ++i)
        {
          const Vector2 a = as[i];
          Vector2       v = vs[i];
          if constexpr (viscous)
            particles.viscous_heat[i] +=
                kick *
                viscous_power(
                    particles.mass[i], particles.viscous[i], v, a, before);
          v.x += kick * a.x;
          v.y += kick * a.y;
          vs[i]   = v;
          ms[i]   = {ms[i].u_x + dt * v.x,
                     ms[i].u_y + dt * v.y,
                     v.x + 0.5 * dt * a.x,
                     v.y + 0.5 * dt * a.y};
          fastest = std::max(fastest, v.x * v.x + v.y * v.y);
        }
      return fastest;
    }
  } // namespace


  void
  Leapfrog::advance(Particles &particles, const double dt)
  {
    const double before                = lag();
    const bool   viscous               = !particles.viscous.empty();
    last_step                          = dt;
    std::atomic<double> fastest_square = 0.; // [m^2/s^2]
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      const double fastest =
          viscous ? move<true>(particles, begin, end, before, dt)
                  : move<false>(particles, begin, end, before, dt);
      double known = fastest_square;
      while (known < fastest &&
             !fastest_square.compare_exchange_weak(known, fastest))
        {}
    });
    particles.travelled += dt * std::sqrt(fastest_square);
  }


  double
  kinetic_energy(const Leapfrog &leapfrog, const Particles &particles)
  {
    return parallel_sum(particles.n_owned, [&](const unsigned int i) {
      const Vector2 v = leapfrog.velocity(particles, i);
      return 0.5 * particles.mass[i] * (v.x * v.x + v.y * v.y);
    });
  }


  double
  viscous_heat(const Leapfrog &leapfrog, const Particles &particles)
  {
    if (particles.viscous.empty())
      return 0.;
    const double lag = leapfrog.lag();
    return parallel_sum(particles.n_owned, [&](const unsigned int i) {
      return particles.viscous_heat[i] +
             lag * viscous_power(particles.mass[i],
                                 particles.viscous[i],
                                 particles.half_velocity[i],
                                 particles.acceleration[i],
                                 lag);
    });
  }


  Vector2
  half_step_momentum(const Particles &particles)
  {
    Vector2 p{0., 0.};
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        p.x += particles.mass[i] * particles.half_velocity[i].x;
        p.y += particles.mass[i] * particles.half_velocity[i].y;
      }
    return p;
  }


  double
  half_step_masses_times_speeds(const Particles &particles)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      sum += particles.mass[i] * std::hypot(particles.half_velocity[i].x,
                                            particles.half_velocity[i].y);
    return sum;
  }
} // namespace Morsel::SPH
