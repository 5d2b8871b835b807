#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/jaw/motion.h>
#include <morsel/jaw/prescribed_motion.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Morsel::Jaw
{
  namespace Patterns = dealii::Patterns;

  void
  MotionParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Kind",
        kind,
        "What moves the body: 'constant' (a velocity), 'sinusoidal' (to and "
        "fro), 'table' (measured); 'force' (a mass on a straight guide under "
        "a force, which hard food slows) or 'jaw' (rides on the hinge of the "
        "section 'Jaw', moved by muscles).",
        Patterns::Selection("constant|sinusoidal|table|force|jaw"));
    prm.add_parameter("Velocity",
                      velocity,
                      "Constant: prescribed velocity 'v_x, v_y' [m/s].");
    prm.add_parameter(
        "Ramp time",
        ramp_time,
        "Constant, force: time in which the velocity or the force is reached "
        "from zero, as sin^2 [s]; 0 starts with an impact.",
        Patterns::Double(0.));
    prm.add_parameter(
        "Approach",
        approach_share,
        "Constant: share [1] of the way to the food's expected failure over "
        "which the "
        "body moves faster; over its second half the speed falls smoothly to "
        "the prescribed one. Up to 0.6 nothing fails yet; 0: none.",
        Patterns::Double(0., 0.9));
    prm.add_parameter(
        "Approach factor",
        approach_factor,
        "Constant: speed of the approach over the prescribed one [1].",
        Patterns::Double(1., 1000.));
    prm.add_parameter(
        "Amplitude",
        amplitude,
        "Sinusoidal: 'x, y' from one end of the way to the other "
        "[m]; displacement = amplitude (1 - cos(2 pi t/period))/2.");
    prm.add_parameter("Period",
                      period,
                      "Sinusoidal: time of one cycle [s].",
                      Patterns::Double(0.));
    prm.add_parameter("Table file",
                      table_file,
                      "Table: lines of 't x y' or 't x y angle' in s, m and "
                      "degrees anticlockwise, beside the scene's file; the "
                      "first line is the place in the scene. Monotone cubic "
                      "in between, at rest before and after.",
                      Patterns::Anything());
    prm.add_parameter("Pivot",
                      pivot,
                      "Table: point 'x, y' about which the angle turns the "
                      "body [m].");
    prm.add_parameter(
        "Force", force, "Force: 'F_x, F_y' along which the body moves [N].");
    prm.add_parameter("Mass",
                      mass,
                      "Force: mass that the force moves [kg].",
                      Patterns::Double(0.));
    prm.add_parameter("Damping",
                      damping,
                      "Force: resistance against the motion [N s/m].",
                      Patterns::Double(0.));
  }


  bool
  MotionParameters::turns() const
  {
    return kind == "jaw" ||
           (kind == "table" &&
            std::any_of(table.angle.begin(),
                        table.angle.end(),
                        [](const double angle) { return angle != 0.; }));
  }


  dealii::Tensor<1, 2>
  MotionParameters::typical_velocity() const
  {
    if (kind == "constant")
      return velocity;
    if (kind == "sinusoidal" && period > 0.)
      return (dealii::numbers::PI / period) * amplitude;
    dealii::Tensor<1, 2> fastest;
    if (kind == "table")
      for (unsigned int k = 1; k < table.time.size(); ++k)
        {
          const dealii::Tensor<1, 2> step(
              {table.shift_x[k] - table.shift_x[k - 1],
               table.shift_y[k] - table.shift_y[k - 1]});
          const auto mean = step / (table.time[k] - table.time[k - 1]);
          if (mean.norm() > fastest.norm())
            fastest = mean;
        }
    return fastest;
  }


  MotionTable
  read_motion_table(const std::string &file_name)
  {
    // A device may have no end.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_name, error))
      throw InputError("there is no file '" + file_name + "'." +
                       did_you_mean(file_name, files_beside(file_name)));
    std::ifstream file(file_name);
    if (!file)
      throw InputError("the file can't be read");
    MotionTable         table;
    std::vector<double> first;
    std::string         line;
    unsigned int        number = 0;
    while (std::getline(file, line))
      {
        ++number;
        for (char &c : line)
          if (c == ',' || c == ';')
            c = ' ';
        std::istringstream  text(line);
        std::vector<double> values;
        for (double value; text >> value;)
          values.push_back(value);
        text.clear();
        std::string rest;
        text >> rest;
        if (values.empty() &&
            (rest.empty() || rest[0] == '#' || table.time.empty()))
          continue;
        const std::string where = "line " + std::to_string(number);
        if (!rest.empty() || values.size() < 3 || values.size() > 4)
          throw InputError(where + " is not 't x y' or 't x y angle'");
        if (!table.time.empty() && values[0] <= table.time.back())
          throw InputError(where + ": times must increase");
        values.resize(4, 0.);
        if (table.time.empty())
          first = values;
        table.time.push_back(values[0]);
        table.shift_x.push_back(values[1] - first[1]);
        table.shift_y.push_back(values[2] - first[2]);
        table.angle.push_back((values[3] - first[3]) * dealii::numbers::PI /
                              180.);
      }
    if (table.time.size() < 4)
      throw InputError("it has " + std::to_string(table.time.size()) +
                       " lines of numbers; give at least 4");
    return table;
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
