#ifndef morsel_sph_outline_cut_h
#define morsel_sph_outline_cut_h

#include <morsel/scene/outline.h>
#include <morsel/sph/voronoi.h>

#include <vector>

namespace Morsel::SPH
{
  /// Cuts convex Voronoi cells with the outline of a body.
  class OutlineCut
  {
  public:
    /// Outline and points are kept by reference.
    /// @param spacing pieces of facets below 1e-9 of it are left out [m]
    OutlineCut(const Scene::Outline                &outline,
               const std::vector<dealii::Point<2>> &points,
               const double                         spacing);

    /// @param convex the cell of particle @p i, who stands inside; a facet
    ///   without a neighbour is where the search for neighbours ended
    /// @return facets of the common part, in order around it, or nothing if
    ///   the search ended inside of the body
    std::vector<CellFacet>
    operator()(const unsigned int            i,
               const std::vector<CellFacet> &convex) const;

  private:
    using Edge = Scene::Outline::Edge;

    std::vector<const Edge *>
    edges_near(const std::vector<CellFacet> &convex) const;

    /// How far a point lies beyond a facet of i's convex cell [m], by the
    /// bisector itself: the same from both of its sides.
    double
    beyond(const unsigned int      i,
           const CellFacet        &facet,
           const dealii::Point<2> &p) const;

    void
    add_part_of_edge(const unsigned int            i,
                     const Edge                   &edge,
                     const std::vector<CellFacet> &convex,
                     std::vector<CellFacet>       &result) const;

    void
    add_parts_inside(const unsigned int               i,
                     const CellFacet                 &facet,
                     const std::vector<const Edge *> &near,
                     std::vector<CellFacet>          &result) const;

    /// What runs along the outline belongs to the outline's edge.
    bool
    lies_inside(const dealii::Point<2>          &p,
                const std::vector<const Edge *> &near) const;

    const Scene::Outline                &outline;
    const std::vector<dealii::Point<2>> &points;
    const double                         tolerance;
  };
} // namespace Morsel::SPH

#endif
