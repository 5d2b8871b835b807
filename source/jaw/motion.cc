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
    prm.add_parameter(
        "Approach",
        approach_share,
        "Share [1] of the way to the food's expected failure over which the "
        "body moves faster; over its second half the speed falls smoothly to "
        "the prescribed one. Up to 0.6 nothing fails yet; 0: none.",
        dealii::Patterns::Double(0., 0.9));
    prm.add_parameter("Approach factor",
                      approach_factor,
                      "Speed of the approach over the prescribed one [1].",
                      dealii::Patterns::Double(1., 1000.));
  }


  namespace
  {
    /// How far a body that is at rest at time 0 has got, and how fast it is.
    struct State
    {
      double way, speed;
    };


    /// Change of speed from one value to another as sin^2 within a time.
    State
    change(const double from, const double to, const double T, const double t)
    {
      const double pi = dealii::numbers::PI;
      const double s  = std::sin(0.5 * pi * t / T);
      return {from * t +
                  (to - from) * (0.5 * t - 0.5 * T / pi * std::sin(pi * t / T)),
              from + (to - from) * s * s};
    }


    /// Times of the approach: the fast speed lasts until slowing, which ends
    /// at the end.
    struct Approach
    {
      double fast, slowing, end;

      explicit Approach(const MotionParameters &motion)
      {
        const double speed = motion.velocity.norm();
        if (!(motion.approach > 0.) || !(motion.approach_factor > 1.) ||
            !(speed > 0.))
          {
            fast    = speed;
            slowing = end = motion.ramp_time;
            return;
          }
        fast    = motion.approach_factor * speed;
        slowing = 0.5 * motion.approach / fast + 0.5 * motion.ramp_time;
        end     = slowing + motion.approach / (fast + speed);
      }
    };


    State
    state_at(const MotionParameters &motion, const double time)
    {
      const double   speed = motion.velocity.norm(), T = motion.ramp_time;
      const Approach approach(motion);
      if (time < T)
        return change(0., approach.fast, T, time);
      if (time < approach.slowing)
        return {approach.fast * (time - 0.5 * T), approach.fast};
      if (time < approach.end)
        {
          State state = change(approach.fast,
                               speed,
                               approach.end - approach.slowing,
                               time - approach.slowing);
          state.way += 0.5 * motion.approach;
          return state;
        }
      return {speed * (time - motion.delay()), speed};
    }


    dealii::Tensor<1, 2>
    direction(const MotionParameters &motion)
    {
      const double speed = motion.velocity.norm();
      return speed > 0. ? motion.velocity / speed : dealii::Tensor<1, 2>();
    }
  } // namespace


  double
  MotionParameters::delay() const
  {
    const Approach times(*this);
    return times.end > ramp_time ? times.end - approach / velocity.norm()
                                 : 0.5 * ramp_time;
  }


  dealii::Tensor<1, 2>
  velocity_at(const MotionParameters &motion, const double time)
  {
    return state_at(motion, time).speed * direction(motion);
  }


  dealii::Tensor<1, 2>
  displacement_at(const MotionParameters &motion, const double time)
  {
    return state_at(motion, time).way * direction(motion);
  }
} // namespace Morsel::Jaw
