#ifndef morsel_jaw_motion_h
#define morsel_jaw_motion_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

namespace Morsel::Jaw
{
  /// Prescribed translation of a rigid body: a constant velocity reached from
  /// rest by a smooth ramp v(t) = v sin^2(pi t / (2 T)).
  struct MotionParameters
  {
    dealii::Point<2> velocity;       ///< [m/s]
    double           ramp_time = 0.; ///< T [s], 0 = at once

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
