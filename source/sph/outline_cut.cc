#include <morsel/sph/outline_cut.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using Scene::Outline;

  namespace
  {
    Point<2>
    between(const Outline::Edge &edge, const double a, const double b)
    {
      return edge.first + a / (a - b) * (edge.second - edge.first);
    }


    /// Each facet behind the one at whose end it begins.
    std::vector<CellFacet>
    in_order(std::vector<CellFacet> facets)
    {
      for (unsigned int k = 0; k + 1 < facets.size(); ++k)
        {
          const Point<2> end = facets[k].second;
          const auto     next =
              std::min_element(facets.begin() + k + 1,
                               facets.end(),
                               [&](const CellFacet &a, const CellFacet &b) {
                                 return end.distance_square(a.first) <
                                        end.distance_square(b.first);
                               });
          std::iter_swap(facets.begin() + k + 1, next);
        }
      return facets;
    }
  } // namespace


  OutlineCut::OutlineCut(const Outline               &outline,
                         const std::vector<Point<2>> &points,
                         const double                 spacing)
      : outline(outline)
      , points(points)
      , tolerance(1e-9 * spacing)
  {}


  std::vector<CellFacet>
  OutlineCut::operator()(const unsigned int            i,
                         const std::vector<CellFacet> &convex) const
  {
    const auto             near = edges_near(convex);
    std::vector<CellFacet> result;
    for (const Edge *edge : near)
      add_part_of_edge(i, *edge, convex, result);
    for (const CellFacet &facet : convex)
      {
        const unsigned int n = result.size();
        if (near.empty())
          result.push_back(facet);
        else
          add_parts_inside(i, facet, near, result);
        if (facet.at_boundary() && result.size() > n)
          return {};
      }
    return in_order(std::move(result));
  }


  std::vector<const Outline::Edge *>
  OutlineCut::edges_near(const std::vector<CellFacet> &convex) const
  {
    Point<2> lower = convex[0].first, upper = convex[0].first;
    for (const CellFacet &facet : convex)
      for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d] = std::min(lower[d], facet.first[d] - tolerance);
          upper[d] = std::max(upper[d], facet.first[d] + tolerance);
        }
    std::vector<const Edge *> near;
    for (const Edge &edge : outline.get_edges())
      if (std::min(edge.first[0], edge.second[0]) < upper[0] &&
          std::max(edge.first[0], edge.second[0]) > lower[0] &&
          std::min(edge.first[1], edge.second[1]) < upper[1] &&
          std::max(edge.first[1], edge.second[1]) > lower[1])
        near.push_back(&edge);
    return near;
  }


  double
  OutlineCut::beyond(const unsigned int i,
                     const CellFacet   &facet,
                     const Point<2>    &p) const
  {
    if (facet.at_boundary())
      return (p - facet.first) * facet.normal();
    const Tensor<1, 2> d = points[facet.neighbour] - points[i];
    return (p - (points[i] + 0.5 * d)) * d / d.norm();
  }


  void
  OutlineCut::add_part_of_edge(const unsigned int            i,
                               const Edge                   &edge,
                               const std::vector<CellFacet> &convex,
                               std::vector<CellFacet>       &result) const
  {
    CellFacet part{edge.first, edge.second, CellFacet::no_particle, edge.side};
    const Tensor<1, 2> along = edge.direction();
    for (const CellFacet &facet : convex)
      {
        const double a = beyond(i, facet, edge.first),
                     b = beyond(i, facet, edge.second);
        if (a > 0. && b > 0.)
          return;
        if (a <= 0. && b <= 0.)
          continue;
        const Point<2> p = between(edge, a, b);
        if (a > 0. && (p - part.first) * along > 0.)
          part.first = p;
        if (b > 0. && (p - part.second) * along < 0.)
          part.second = p;
      }
    if ((part.second - part.first) * along > tolerance)
      result.push_back(part);
  }


  void
  OutlineCut::add_parts_inside(const unsigned int               i,
                               const CellFacet                 &facet,
                               const std::vector<const Edge *> &near,
                               std::vector<CellFacet>          &result) const
  {
    if (facet.length() <= tolerance)
      return;
    const Tensor<1, 2> along = (facet.second - facet.first) / facet.length();
    const auto         place = [&](const Point<2> &p) {
      return (p - facet.first) * along;
    };
    std::vector<Point<2>> cuts = {facet.first, facet.second};
    for (const Edge *edge : near)
      {
        const double a = beyond(i, facet, edge->first),
                     b = beyond(i, facet, edge->second);
        if ((a > 0.) == (b > 0.))
          continue;
        const Point<2> p = between(*edge, a, b);
        if (place(p) > 0. && place(p) < facet.length())
          cuts.push_back(p);
      }
    std::sort(cuts.begin(), cuts.end(), [&](auto &p, auto &q) {
      return place(p) < place(q);
    });
    bool goes_on = false;
    for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
      {
        if (place(cuts[k + 1]) - place(cuts[k]) <= tolerance)
          continue;
        const Point<2> middle = cuts[k] + 0.5 * (cuts[k + 1] - cuts[k]);
        const bool     inside = lies_inside(middle, near);
        if (inside && goes_on)
          result.back().second = cuts[k + 1];
        else if (inside)
          result.push_back({cuts[k], cuts[k + 1], facet.neighbour, 0});
        goes_on = inside;
      }
  }


  bool
  OutlineCut::lies_inside(const Point<2>                  &p,
                          const std::vector<const Edge *> &near) const
  {
    for (const Edge *edge : near)
      {
        const Tensor<1, 2> along = edge->direction();
        const Tensor<1, 2> d     = p - edge->first;
        if (std::abs(along[0] * d[1] - along[1] * d[0]) < tolerance &&
            along * d > 0. && along * d < edge->length())
          return false;
      }
    return outline.contains(p);
  }
} // namespace Morsel::SPH
