#ifndef morsel_sph_leapfrog_h
#define morsel_sph_leapfrog_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/sph/particles.h>

namespace Morsel::SPH
{
  /// Leapfrog in time (T3-28 to T3-31 corrected): velocities half a step
  /// ahead of displacements, from velocities and displacements at time 0.
  class Leapfrog
  {
  public:
    /// v_{n+1/2} = v_{n-1/2} + a_n (dt' + dt)/2, where dt' is the step before
    /// (0 at first), u_{n+1} = u_n + v_{n+1/2} dt, and the velocity predicted
    /// for the time of u_{n+1}.
    void
    advance(Particles &particles, double time_step);

    /// From the velocities' last half step to the time of the displacements
    /// [s].
    double
    lag() const
    {
      return 0.5 * last_step;
    }

    /// Velocity at the time of the displacements and accelerations [m/s].
    Vector2
    velocity(const Particles &particles, const unsigned int i) const
    {
      const Vector2 &v = particles.half_velocity[i];
      const Vector2 &a = particles.acceleration[i];
      const double   t = lag();
      return {v.x + t * a.x, v.y + t * a.y};
    }

    void
    exchange_state(StateArchive &state);

  private:
    double last_step = 0.; ///< [s]
  };


  /// Energy of that velocity [J], of the particles of this rank.
  double
  kinetic_energy(const Leapfrog &leapfrog, const Particles &particles);

  /// What artificial viscosity turned into heat until the time of the
  /// displacements and accelerations [J], of the particles of this rank; 0
  /// without it.
  double
  viscous_heat(const Leapfrog &leapfrog, const Particles &particles);

  /// Momentum at the last half step [kg m/s], of the particles of this rank.
  Vector2
  half_step_momentum(const Particles &particles);

  /// Sum of masses times speeds at that time [kg m/s], of the particles of this
  /// rank: what the momentum is small against where it cancels.
  double
  half_step_masses_times_speeds(const Particles &particles);
} // namespace Morsel::SPH

#endif
