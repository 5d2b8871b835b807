#ifndef morsel_sph_stable_step_h
#define morsel_sph_stable_step_h

#include <cmath>

namespace Morsel::SPH
{
  /// Largest stable leapfrog step [s] of a system whose highest frequency
  /// squared is @p w2 [1/s^2], damped at the rate @p g [1/s] by a viscosity
  /// that is evaluated at a predicted velocity: w^2 dt^2/4 + g dt/2 < 1. A
  /// damper that acts both ways would count in full, w^2 dt^2/4 + g dt < 1;
  /// artificial viscosity acts on approaching pairs alone, on half of a wave's.
  ///
  /// Friction that stops the share @p stopped of a slip in every step [1] is a
  /// damper of the rate stopped/dt, however short the step. It acts along the
  /// surface alone, on half of the energy of the shortest waves there:
  /// w^2 dt^2/4 + g dt/2 + stopped/2 < 1.
  inline double
  largest_stable_step(const double w2,
                      const double g,
                      const double stopped = 0.)
  {
    const double room = 1. - 0.5 * stopped;
    return (std::sqrt(0.25 * g * g + room * w2) - 0.5 * g) * 2. / w2;
  }


  /// Rate at which linear artificial viscosity damps the shortest wave of a
  /// lattice [1/s], from the sum over its pairs.
  inline double
  viscous_damping_rate(const double alpha_c, const double spacing)
  {
    return 1.54 * alpha_c / spacing;
  }


  /// Square of the highest frequency of a lattice [1/s^2]: undamped it is
  /// stable up to about 1.0 h/c (measured; the interior alone would allow 1.75
  /// to 2.3, whatever the kernel).
  inline double
  square_of_highest_frequency(const double wave_speed, const double h)
  {
    return 4. * wave_speed * wave_speed / (h * h);
  }
} // namespace Morsel::SPH

#endif
