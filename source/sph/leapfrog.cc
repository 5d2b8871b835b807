#include <morsel/core/parallel.h>
#include <morsel/sph/leapfrog.h>

namespace Morsel::SPH
{
  void
  Leapfrog::advance(Particles &particles, const double dt)
  {
    const double kick = lag(dt) + 0.5 * dt;
    started           = true;
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        {
          const Vector2 a = particles.acceleration[i];
          Vector2      &v = particles.half_velocity[i];
          Motion       &m = particles.motion[i];
          v.x += kick * a.x;
          v.y += kick * a.y;
          m.u_x += dt * v.x;
          m.u_y += dt * v.y;
          m.v_x = v.x + 0.5 * dt * a.x;
          m.v_y = v.y + 0.5 * dt * a.y;
        }
    });
  }


  double
  kinetic_energy(const Leapfrog  &leapfrog,
                 const Particles &particles,
                 const double     time_step)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const Vector2 v = leapfrog.velocity(particles, i, time_step);
        sum += 0.5 * particles.mass[i] * (v.x * v.x + v.y * v.y);
      }
    return sum;
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
} // namespace Morsel::SPH
