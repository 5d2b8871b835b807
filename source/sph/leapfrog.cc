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
    double
    viscous_power(const Particles &p, const unsigned int i, const double lag)
    {
      const Vector2 v = p.half_velocity[i], a = p.acceleration[i];
      return -p.mass[i] * (p.viscous[i].x * (v.x + lag * a.x) +
                           p.viscous[i].y * (v.y + lag * a.y));
    }
  } // namespace


  void
  Leapfrog::advance(Particles &particles, const double dt)
  {
    const double before                = lag();
    const double kick                  = before + 0.5 * dt;
    const bool   viscous               = !particles.viscous.empty();
    last_step                          = dt;
    std::atomic<double> fastest_square = 0.; // [m^2/s^2]
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      double fastest = 0.;
      for (unsigned int i = begin; i < end; ++i)
        {
          const Vector2 a = particles.acceleration[i];
          Vector2      &v = particles.half_velocity[i];
          Motion       &m = particles.motion[i];
          if (viscous)
            particles.viscous_heat[i] +=
                kick * viscous_power(particles, i, before);
          v.x += kick * a.x;
          v.y += kick * a.y;
          m.u_x += dt * v.x;
          m.u_y += dt * v.y;
          m.v_x   = v.x + 0.5 * dt * a.x;
          m.v_y   = v.y + 0.5 * dt * a.y;
          fastest = std::max(fastest, v.x * v.x + v.y * v.y);
        }
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
      return particles.viscous_heat[i] + lag * viscous_power(particles, i, lag);
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
