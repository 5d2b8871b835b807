#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/outline.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel::Scene
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    using Edge = Outline::Edge;
    using Loop = Outline::Loop;


    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }


    std::string
    place(const Point<2> &p)
    {
      return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ") m";
    }


    double
    signed_area(const std::vector<Point<2>> &corners)
    {
      double sum = 0.;
      for (unsigned int k = 0; k < corners.size(); ++k)
        sum += 0.5 * cross(corners[k] - corners[0],
                           corners[(k + 1) % corners.size()] - corners[0]);
      return sum;
    }


    void
    reverse(Loop &loop)
    {
      std::reverse(loop.corners.begin(), loop.corners.end());
      // Edge k led from corner k: its corners now stand in places n-1-k and
      // n-2-k.
      std::reverse(loop.sides.begin(), loop.sides.end());
      std::rotate(loop.sides.begin(), loop.sides.begin() + 1, loop.sides.end());
    }


    double
    distance_to_edge(const Point<2> &p, const Edge &edge)
    {
      const Tensor<1, 2> d = edge.second - edge.first;
      const double       s =
          std::clamp((p - edge.first) * d / d.norm_square(), 0., 1.);
      return p.distance(edge.first + s * d);
    }


    /// Whether two edges have a point in common.
    bool
    meet(const Edge &a, const Edge &b, const double tolerance)
    {
      const Tensor<1, 2> d = a.second - a.first, e = b.second - b.first;
      const double       s = cross(d, b.first - a.first),
                   t       = cross(d, b.second - a.first);
      const double u       = cross(e, a.first - b.first),
                   v       = cross(e, a.second - b.first);
      return (s * t < 0. && u * v < 0.) ||
             distance_to_edge(a.first, b) < tolerance ||
             distance_to_edge(a.second, b) < tolerance ||
             distance_to_edge(b.first, a) < tolerance ||
             distance_to_edge(b.second, a) < tolerance;
    }


    /// Neighbours in a loop share a corner: they must not fold back.
    bool
    folds_back(const Edge &edge, const Edge &next)
    {
      return cross(edge.direction(), next.direction()) > -1e-9 &&
             cross(edge.direction(), next.direction()) < 1e-9 &&
             edge.direction() * next.direction() < 0.;
    }


    bool
    apart(const Edge &a, const Edge &b, const double margin)
    {
      for (unsigned int d = 0; d < 2; ++d)
        if (std::min(a.first[d], a.second[d]) >
                std::max(b.first[d], b.second[d]) + margin ||
            std::min(b.first[d], b.second[d]) >
                std::max(a.first[d], a.second[d]) + margin)
          return true;
      return false;
    }


    void
    check_loops(const std::vector<Edge>         &edges,
                const std::vector<unsigned int> &starts,
                const double                     tolerance)
    {
      for (unsigned int l = 0; l + 1 < starts.size(); ++l)
        for (unsigned int i = starts[l]; i < starts[l + 1]; ++i)
          {
            const unsigned int next = i + 1 < starts[l + 1] ? i + 1 : starts[l];
            if (folds_back(edges[i], edges[next]))
              throw InputError("the boundary turns back on itself at " +
                               place(edges[i].second));
            for (unsigned int j = i + 1; j < edges.size(); ++j)
              {
                const bool neighbours =
                    j == next || (i == starts[l] && j + 1 == starts[l + 1]);
                if (!neighbours && !apart(edges[i], edges[j], tolerance) &&
                    meet(edges[i], edges[j], tolerance))
                  throw InputError("the edges from " + place(edges[i].first) +
                                   " and from " + place(edges[j].first) +
                                   " meet; a boundary must neither cross nor "
                                   "touch itself or another one");
              }
          }
    }


    bool
    inside(const Point<2> &p, const Edge *const begin, const Edge *const end)
    {
      bool in = false;
      for (const Edge *edge = begin; edge != end; ++edge)
        {
          const Point<2> &a = edge->first, &b = edge->second;
          if ((a[1] > p[1]) != (b[1] > p[1]) &&
              p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            in = !in;
        }
      return in;
    }
  } // namespace


  Outline::Outline(std::vector<Loop> loops, std::vector<std::string> side_names)
      : starts(1, 0u)
      , names(std::move(side_names))
  {
    for (const Loop &loop : loops)
      if (loop.corners.size() < 3)
        throw InputError("a loop has " + std::to_string(loop.corners.size()) +
                         " corner(s), but needs at least three");
    std::stable_sort(
        loops.begin(), loops.end(), [](const Loop &a, const Loop &b) {
          return std::abs(signed_area(a.corners)) >
                 std::abs(signed_area(b.corners));
        });
    for (unsigned int l = 0; l < loops.size(); ++l)
      {
        Loop &loop = loops[l];
        if ((signed_area(loop.corners) > 0.) != (l == 0))
          reverse(loop);
        const unsigned int n = loop.corners.size();
        for (unsigned int k = 0; k < n; ++k)
          edges.push_back(
              {loop.corners[k], loop.corners[(k + 1) % n], loop.sides[k]});
        starts.push_back(edges.size());
      }
    const double tolerance = 1e-9 * lower().distance(upper());
    for (const Edge &edge : edges)
      if (!(edge.length() > tolerance))
        throw InputError("the edge at " + place(edge.first) + " has no length");
    check_loops(edges, starts, tolerance);
    for (unsigned int l = 1; l < loops.size(); ++l)
      for (unsigned int k = 0; k < l; ++k)
        if (inside(edges[starts[l]].first,
                   &edges[starts[k]],
                   &edges[starts[k]] + (starts[k + 1] - starts[k])) != (k == 0))
          throw InputError("the hole at " + place(edges[starts[l]].first) +
                           (k == 0 ? " lies outside of the largest loop, the "
                                     "body"
                                   : " lies in another hole"));
  }


  Outline
  Outline::rectangle(const Point<2> &lower, const Point<2> &upper)
  {
    const Loop loop{{lower,
                     Point<2>(upper[0], lower[1]),
                     upper,
                     Point<2>(lower[0], upper[1])},
                    {2, 1, 3, 0}};
    return Outline({loop}, {"left", "right", "bottom", "top"});
  }


  unsigned int
  Outline::side_named(const std::string &name) const
  {
    return std::find(names.begin(), names.end(), name) - names.begin();
  }


  Point<2>
  Outline::lower() const
  {
    Point<2> corner = edges.front().first;
    for (const Edge &edge : edges)
      for (unsigned int d = 0; d < 2; ++d)
        corner[d] = std::min(corner[d], edge.first[d]);
    return corner;
  }


  Point<2>
  Outline::upper() const
  {
    Point<2> corner = edges.front().first;
    for (const Edge &edge : edges)
      for (unsigned int d = 0; d < 2; ++d)
        corner[d] = std::max(corner[d], edge.first[d]);
    return corner;
  }


  double
  Outline::area() const
  {
    const Point<2> &origin = edges.front().first;
    double          sum    = 0.;
    for (const Edge &edge : edges)
      sum += 0.5 * cross(edge.first - origin, edge.second - origin);
    return sum;
  }


  bool
  Outline::contains(const Point<2> &p) const
  {
    return inside(p, edges.data(), edges.data() + edges.size());
  }


  double
  Outline::distance(const Point<2> &p) const
  {
    double best = std::numeric_limits<double>::max();
    for (const Edge &edge : edges)
      best = std::min(best, distance_to_edge(p, edge));
    return best;
  }


  std::vector<Outline::Edge>
  Outline::walls() const
  {
    return is_convex() ? std::vector<Edge>() : edges;
  }


  bool
  Outline::is_convex() const
  {
    if (starts.size() > 2)
      return false;
    for (unsigned int k = 0; k < edges.size(); ++k)
      if (cross(edges[k].direction(),
                edges[(k + 1) % edges.size()].direction()) < -1e-9)
        return false;
    return true;
  }
} // namespace Morsel::Scene
