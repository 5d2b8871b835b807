#ifndef morsel_jaw_motion_h
#define morsel_jaw_motion_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Morsel::Jaw
{
  /// A measured motion: displacements by time, and the angle of the body.
  struct MotionTable
  {
    std::vector<double> time;    ///< [s], increasing
    std::vector<double> shift_x; ///< [m]
    std::vector<double> shift_y; ///< [m]
    std::vector<double> angle;   ///< [rad], anticlockwise
  };


  /// What moves a plate.
  struct MotionParameters
  {
    /// "constant", "sinusoidal" and "table" are prescribed, "force" and
    /// "jaw" answer the food.
    std::string kind = "constant";

    // A constant velocity reached from rest by a smooth ramp v(t) = v
    // sin^2(pi t / (2 T)). An approach of the way A is faster by a factor a:
    // the ramp leads to a v, and over the second half of A the speed falls to
    // v, again as sin^2, within A / (a v + v).
    dealii::Point<2> velocity;             ///< [m/s]
    double           ramp_time       = 0.; ///< T [s], 0 = at once
    double           approach_share  = 0.; ///< of the expected failure [1]
    double           approach_factor = 1.; ///< a [1]
    double           approach        = 0.; ///< A [m], follows from the scene

    // To and fro: displacement = amplitude (1 - cos(2 pi t / period)) / 2.
    dealii::Point<2> amplitude;   ///< [m]
    double           period = 0.; ///< [s]

    // Measured.
    std::string      table_file;
    MotionTable      table;
    dealii::Point<2> pivot; ///< about which its angle turns [m]

    // A mass on a straight guide along a given force, which sets in with the
    // ramp.
    dealii::Point<2> force;        ///< [N]
    double           mass    = 0.; ///< [kg]
    double           damping = 0.; ///< [N s/m]

    bool
    is_prescribed() const
    {
      return kind != "force" && kind != "jaw";
    }

    bool
    turns() const;

    /// Whether a body with inertia of its own can follow: its drive is known
    /// beforehand and does not turn it.
    bool
    carries_dynamic_bodies() const
    {
      return is_prescribed() && !turns();
    }

    /// Velocity by which times are estimated [m/s]: the constant one, the
    /// largest of the others, 0 where it depends on the food.
    dealii::Tensor<1, 2>
    typical_velocity() const;

    /// Time [s] by which the body, once it has its constant velocity, is behind
    /// one that always had it: T / 2 without an approach, negative with one
    /// that gains time; displacement(t) = velocity (t - delay).
    double
    delay() const;

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// Reads a table of 't x y [angle]' per line, in seconds, metres and degrees,
  /// separated by blanks or commas; lines that begin with '#' and a head of
  /// words are skipped.
  /// @throws InputError
  MotionTable
  read_motion_table(const std::string &file_name);
} // namespace Morsel::Jaw

#endif
