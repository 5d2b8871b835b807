#ifndef morsel_jaw_motion_h
#define morsel_jaw_motion_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

namespace Morsel::Jaw
{
  /// Prescribed translation of a rigid body: a constant velocity reached from
  /// rest by a smooth ramp v(t) = v sin^2(pi t / (2 T)). An approach of the way
  /// A is faster by a factor a: the ramp leads to a v, and over the second
  /// half of A the speed falls to v, again as sin^2, within A / (a v + v).
  struct MotionParameters
  {
    dealii::Point<2> velocity;             ///< [m/s]
    double           ramp_time       = 0.; ///< T [s], 0 = at once
    double           approach_share  = 0.; ///< of the expected failure [1]
    double           approach_factor = 1.; ///< a [1]
    double           approach        = 0.; ///< A [m], follows from the scene

    /// Time [s] by which the body, once it has its velocity, is behind one
    /// that always had it: T / 2 without an approach, negative with one that
    /// gains time; displacement(t) = velocity (t - delay).
    double
    delay() const;

    void
    declare(dealii::ParameterHandler &prm);
  };

  /// Velocity at a time [m/s].
  dealii::Tensor<1, 2>
  velocity_at(const MotionParameters &motion, double time);

  /// Displacement since time 0 [m].
  dealii::Tensor<1, 2>
  displacement_at(const MotionParameters &motion, double time);
} // namespace Morsel::Jaw

#endif
