#include <morsel/scene/outline.h>

#include <cmath>
#include <limits>

namespace Morsel::Scene
{
  namespace
  {
    /// Points along an outline, besides its corners.
    constexpr double points_along = 400.;


    /// Looks from the points of one outline at the other.
    void
    look(const Outline &from, const Outline &at, Separation &nearest)
    {
      double length = 0.;
      for (const Outline::Edge &edge : from.get_edges())
        length += edge.length();
      for (const Outline::Edge &edge : from.get_edges())
        {
          const unsigned int n =
              std::ceil(edge.length() / length * points_along);
          for (unsigned int k = 0; k < n; ++k)
            {
              const dealii::Point<2> p =
                  edge.first +
                  (static_cast<double>(k) / n) * (edge.second - edge.first);
              const double distance = at.distance(p);
              const double gap      = at.contains(p) ? -distance : distance;
              if (gap < nearest.gap)
                nearest = {gap, p};
            }
        }
    }
  } // namespace


  Separation
  separation(const Outline &a, const Outline &b)
  {
    Separation nearest{std::numeric_limits<double>::infinity(), {}};
    look(a, b, nearest);
    look(b, a, nearest);
    return nearest;
  }
} // namespace Morsel::Scene
