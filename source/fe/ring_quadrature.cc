#include <morsel/fe/ring_quadrature.h>

#include <algorithm>
#include <cmath>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Quadrature over the part of a cell that the rings reach. The weight of
    /// a ring varies over its width and has kinks of its fourth derivative at
    /// both radii: larger cells are divided. With parts of 0.4 of the width
    /// and six points beyond the degree the rule costs K less than 1e-8 (with
    /// 0.6 and four it cost 3e-6).
    CellQuadrature
    ring_quadrature(const XFEMSpace                    &space,
                    const DoFHandler<2>::cell_iterator &cell,
                    const QuadMap                      &map,
                    const Fracture::CrackTip           &tip,
                    const double                        inside,
                    const double                        reach,
                    const double                        resolution)
    {
      const CellEnrichment &e = space.get_enrichment(cell->active_cell_index());
      const unsigned int    n =
          space.get_numbering(cell->active_fe_index()).degree + 6;
      const unsigned int k =
          std::ceil(map.diameter() / std::sqrt(2.) / resolution);
      CellQuadrature all;
      for (unsigned int j = 0; j < k; ++j)
        for (unsigned int i = 0; i < k; ++i)
          {
            std::array<Point<2>, 4> corners;
            double                  nearest = 1e300, farthest = 0.;
            for (unsigned int v = 0; v < 4; ++v)
              {
                corners[v] = map.to_physical(
                    Point<2>((i + v % 2) / double(k), (j + v / 2) / double(k)));
                farthest =
                    std::max(farthest, corners[v].distance(tip.position));
              }
            const QuadMap part(corners);
            nearest = distance_to_polygon(tip.position, part.polygon());
            if (nearest >= reach || farthest <= inside)
              continue;
            const auto pieces =
                e.cut ? cut_into_pieces(part.polygon(), space.get_cracks())
                      : std::vector<Polygon>(1, part.polygon());
            const CellQuadrature q = pieces.size() == 1
                                         ? gauss_quadrature(part, n)
                                         : cut_quadrature(part, pieces, {}, n);
            all.points.insert(
                all.points.end(), q.points.begin(), q.points.end());
            all.weights.insert(
                all.weights.end(), q.weights.begin(), q.weights.end());
          }
      for (const Point<2> &p : all.points)
        all.reference.push_back(map.to_reference(p));
      return all;
    }
  } // namespace


  void
  for_each_ring_cell(const XFEMSpace                   &space,
                     const Fracture::CrackTip          &tip,
                     const std::vector<Fracture::Ring> &rings,
                     const UseOfRingCell               &use)
  {
    double reach = 0., inside = 1e300, resolution = 1e300;
    for (const Fracture::Ring &ring : rings)
      {
        reach  = std::max(reach, ring.outer_radius);
        inside = std::min(inside, ring.inner_radius);
        resolution =
            std::min(resolution, 0.4 * (ring.outer_radius - ring.inner_radius));
      }
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const double r = cell->center().distance(tip.position);
        const double d = 0.5 * cell->diameter();
        if (r - d > reach || r + d < inside)
          continue;
        const QuadMap        map = make_map(cell);
        const CellQuadrature q =
            ring_quadrature(space, cell, map, tip, inside, reach, resolution);
        if (!q.points.empty())
          use(cell, map, q);
      }
  }
} // namespace Morsel::FE
