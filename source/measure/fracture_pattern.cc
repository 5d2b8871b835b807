#include <morsel/measure/fracture_pattern.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Morsel::Measure
{
  using dealii::ArrayView;
  using dealii::Point;

  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Directions that are tried, over half a turn.
    constexpr unsigned int n_directions = 180;

    /// Bands meet strips at different places; one of these offsets fits.
    constexpr unsigned int n_offsets = 3;

    /// Width of a strip in spacings, and in smaller extents of the body.
    constexpr double width_in_spacings = 3., width_in_extents = 0.03;

    /// Damage that varies less than this is none.
    constexpr double least_variance = 1e-12;


    /// The mean damage and its variance, weighted with areas.
    struct Moments
    {
      Moments(const ArrayView<const double> areas,
              const ArrayView<const double> damage)
      {
        for (std::size_t i = 0; i < damage.size(); ++i)
          {
            area += areas[i];
            mean += areas[i] * damage[i];
          }
        mean /= area;
        for (std::size_t i = 0; i < damage.size(); ++i)
          variance += areas[i] * (damage[i] - mean) * (damage[i] - mean);
        variance /= area;
      }

      double area = 0., mean = 0., variance = 0.;
    };


    struct Body
    {
      const ArrayView<const Point<2>> positions;
      const ArrayView<const double>   areas, damage;
      const Moments                   moments;
      const double                    width; ///< of a strip [m]
      const Point<2>                  corner;
      const double                    reach; ///< of the body from its corner
    };


    /// The lower left and upper right corner of all points.
    std::pair<Point<2>, Point<2>>
    corners(const ArrayView<const Point<2>> positions)
    {
      Point<2> lower = positions[0], upper = positions[0];
      for (const Point<2> &x : positions)
        for (unsigned int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
      return {lower, upper};
    }


    /// Share of the variance of damage between strips along a direction at
    /// @p angle to x [1].
    double
    explained(const Body &body, const double angle, const double offset)
    {
      const double        n_x = -std::sin(angle), n_y = std::cos(angle);
      const unsigned int  n = 2 * std::ceil(body.reach / body.width) + 3;
      std::vector<double> area(n, 0.), damage(n, 0.);
      for (std::size_t i = 0; i < body.positions.size(); ++i)
        {
          const auto   x = body.positions[i] - body.corner;
          const double s =
              (n_x * x[0] + n_y * x[1] + body.reach) / body.width + offset;
          const auto strip = static_cast<unsigned int>(s);
          area[strip] += body.areas[i];
          damage[strip] += body.areas[i] * (body.damage[i] - body.moments.mean);
        }
      double sum = 0.;
      for (unsigned int k = 0; k < n; ++k)
        if (area[k] > 0.)
          sum += damage[k] * damage[k] / area[k];
      return sum / (body.moments.area * body.moments.variance);
    }


    double
    explained_at_best(const Body &body, const double angle)
    {
      double best = 0.;
      for (unsigned int k = 0; k < n_offsets; ++k)
        best = std::max(
            best, explained(body, angle, static_cast<double>(k) / n_offsets));
      return best;
    }
  } // namespace


  std::optional<FracturePattern>
  fracture_pattern(const ArrayView<const Point<2>> positions,
                   const ArrayView<const double>   areas,
                   const ArrayView<const double>   damage,
                   const unsigned int              axis,
                   const double                    spacing)
  {
    AssertDimension(positions.size(), damage.size());
    AssertDimension(areas.size(), damage.size());
    if (positions.size() == 0)
      return std::nullopt;
    const Moments moments(areas, damage);
    if (!(moments.variance > least_variance))
      return std::nullopt;
    const auto   box    = corners(positions);
    const auto   extent = box.second - box.first;
    const double width =
        std::max(width_in_spacings * spacing,
                 width_in_extents * std::min(extent[0], extent[1]));
    const Body body{positions,
                    areas,
                    damage,
                    moments,
                    width,
                    box.first,
                    extent.norm() + spacing};

    double          sum = 0., degrees = 0.; // of the best, from x
    FracturePattern pattern;
    for (unsigned int k = 0; k < n_directions; ++k)
      {
        const double share = explained_at_best(body, pi * k / n_directions);
        sum += share;
        if (share > pattern.explained)
          {
            pattern.explained = share;
            degrees           = 180. * k / n_directions;
          }
      }
    // Against the axis, whichever way it turns.
    const double turned   = std::abs(degrees - (axis == 0 ? 0. : 90.));
    pattern.angle         = std::min(turned, 180. - turned);
    pattern.sharpness     = pattern.explained - sum / n_directions;
    pattern.damaged_share = moments.mean;
    return pattern;
  }
} // namespace Morsel::Measure
