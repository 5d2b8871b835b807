#ifndef morsel_core_movement_watch_h
#define morsel_core_movement_watch_h

#include <cmath>
#include <limits>

namespace Morsel
{
  /// Tells when points have moved too far for what was found at their places,
  /// without looking at all of them each time: none can have moved further than
  /// the fastest of them at each step.
  class MovementWatch
  {
  public:
    /// From here on, when no point has gone further than @p travelled [m] since
    /// some time in the past.
    void
    begin(const double travelled)
    {
      known_at = travelled;
      distance = 0.;
    }

    /// What is known does not hold any more.
    void
    forget()
    {
      known_at = unknown;
    }

    /// By how far a point may have moved since begin() [m]; not a number after
    /// forget().
    double
    bound(const double travelled) const
    {
      return distance + (travelled - known_at);
    }

    /// Whether a point has moved by more than @p limit [m] since begin().
    /// @param travelled as for begin(); unknown if it is not a number
    /// @param largest_square looks at all: the square of the largest distance
    ///   [m^2]
    template <typename Function>
    bool
    beyond(const double    limit,
           const double    travelled,
           const Function &largest_square)
    {
      if (bound(travelled) < rounding * limit)
        return false;
      const double square = largest_square();
      distance            = std::sqrt(square);
      known_at            = travelled;
      return square > limit * limit;
    }

    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  private:
    /// Sums of many steps are rounded.
    static constexpr double rounding = 1. - 1e-9;

    double known_at = unknown, distance = 0.; ///< [m]
  };
} // namespace Morsel

#endif
