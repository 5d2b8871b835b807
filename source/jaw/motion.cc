#include <morsel/jaw/motion.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <cmath>

namespace Morsel::Jaw
{
  void
  MotionParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Velocity", velocity, "Prescribed velocity 'v_x, v_y' [m/s].");
    prm.add_parameter(
        "Ramp time",
        ramp_time,
        "Time in which the velocity is reached from rest, as sin^2 [s]; 0 "
        "starts with an impact.",
        dealii::Patterns::Double(0.));
  }


  dealii::Tensor<1, 2>
  velocity_at(const MotionParameters &motion, const double time)
  {
    if (time >= motion.ramp_time)
      return motion.velocity;
    const double s =
        std::sin(0.5 * dealii::numbers::PI * time / motion.ramp_time);
    return motion.velocity * (s * s);
  }


  dealii::Tensor<1, 2>
  displacement_at(const MotionParameters &motion, const double time)
  {
    const double T = motion.ramp_time;
    if (time >= T)
      return motion.velocity * (time - 0.5 * T);
    const double pi = dealii::numbers::PI;
    return motion.velocity *
           (0.5 * time - 0.5 * T / pi * std::sin(pi * time / T));
  }
} // namespace Morsel::Jaw
