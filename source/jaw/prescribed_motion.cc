#include <morsel/jaw/prescribed_motion.h>

#include <deal.II/base/numbers.h>

// Boost 1.74's pchip calls isnan without its namespace.
#include <math.h>

#include <boost/math/interpolators/pchip.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace Morsel::Jaw
{
  /// Monotone between the points, so that nothing swings that was not
  /// measured to (Fritsch and Butland 1984).
  struct PrescribedMotion::Interpolation
  {
    using Cubic = boost::math::interpolators::pchip<std::vector<double>>;

    explicit Interpolation(const MotionTable &table)
        : first(table.time.front())
        , last(table.time.back())
        , columns{{make(table.time, table.shift_x),
                   make(table.time, table.shift_y),
                   make(table.time, table.angle)}}
    {}

    static Cubic
    make(std::vector<double> time, std::vector<double> values)
    {
      return {std::move(time), std::move(values)};
    }

    /// Value and slope of a column.
    std::pair<double, double>
    at(const unsigned int column, const double time) const
    {
      const bool outside = time < first || time > last;
      return {columns[column](std::clamp(time, first, last)),
              outside ? 0.
                      : columns[column].prime(std::clamp(time, first, last))};
    }

    const double               first, last;
    const std::array<Cubic, 3> columns;
  };


  PrescribedMotion::PrescribedMotion(const MotionParameters &parameters)
      : parameters(parameters)
      , table(parameters.kind == "table"
                  ? std::make_unique<Interpolation>(parameters.table)
                  : nullptr)
  {}


  PrescribedMotion::~PrescribedMotion()                            = default;
  PrescribedMotion::PrescribedMotion(PrescribedMotion &&) noexcept = default;


  Frame
  PrescribedMotion::at(const double time) const
  {
    Frame frame;
    if (table)
      {
        frame.pivot = parameters.pivot;
        for (unsigned int d = 0; d < 2; ++d)
          {
            const auto [place, speed] = table->at(d, time);
            frame.shift[d]            = place;
            frame.velocity[d]         = speed;
          }
        std::tie(frame.angle, frame.spin) = table->at(2, time);
      }
    else if (parameters.kind == "sinusoidal")
      {
        const double omega = 2. * dealii::numbers::PI / parameters.period;
        frame.shift =
            0.5 * (1. - std::cos(omega * time)) * parameters.amplitude;
        frame.velocity =
            0.5 * omega * std::sin(omega * time) * parameters.amplitude;
      }
    else
      {
        frame.shift    = displacement_at(parameters, time);
        frame.velocity = velocity_at(parameters, time);
      }
    return frame;
  }
} // namespace Morsel::Jaw
