#ifndef morsel_sph_voronoi_h
#define morsel_sph_voronoi_h

#include <morsel/scene/outline.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Morsel::SPH
{
  /// An edge of a Voronoi cell, counter-clockwise about the cell.
  struct CellFacet
  {
    static constexpr unsigned int no_particle = static_cast<unsigned int>(-1);

    dealii::Point<2> first, second;           ///< [m]
    unsigned int     neighbour = no_particle; ///< behind it; none at the edge
    /// Of the outline (of a rectangle left, right, bottom, top), where there
    /// is no neighbour.
    unsigned int side = 0;

    bool
    at_boundary() const
    {
      return neighbour == no_particle;
    }

    double
    length() const
    {
      return first.distance(second);
    }

    /// Unit normal out of the cell.
    dealii::Tensor<1, 2>
    normal() const
    {
      const dealii::Tensor<1, 2> t = (second - first) / length();
      return dealii::Tensor<1, 2>({t[1], -t[0]});
    }
  };


  /// What lies nearer to one particle than to any other. Facets follow each
  /// other around the cell.
  struct VoronoiCell
  {
    std::vector<CellFacet> facets;
    double                 area = 0.; ///< [m^2]
    dealii::Point<2>       centroid;  ///< [m]
  };


  /// The Voronoi cells of points in a rectangle, each cut out of it by the
  /// perpendicular bisectors to its neighbours, nearest first.
  /// @param points  inside of the rectangle, no two alike [m]
  /// @param spacing typical distance of neighbours [m]: facets below 1e-9 of
  ///   it are left out
  /// @param wanted  which cells to make; empty: all
  std::vector<VoronoiCell>
  voronoi_cells(const std::vector<dealii::Point<2>> &points,
                const dealii::Point<2>              &lower,
                const dealii::Point<2>              &upper,
                const double                         spacing,
                const std::vector<char>             &wanted = {});


  /// The Voronoi cells of points in a body of any outline: the convex cells
  /// of the whole plane, cut with the body. A cell's boundary is what lies of
  /// the outline in the convex cell and of the convex cell's in the body, so
  /// that areas add up to the body's and the surface vectors of each cell to
  /// nothing, but for round-off. Cells of a body with holes and recesses may
  /// be in parts or have holes.
  /// @param points inside of the outline, no two alike [m]
  /// @param spacing as above
  std::vector<VoronoiCell>
  voronoi_cells(const std::vector<dealii::Point<2>> &points,
                const Scene::Outline                &outline,
                const double                         spacing);
} // namespace Morsel::SPH

#endif
