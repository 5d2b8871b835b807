#ifndef morsel_fe_cut_quadrature_h
#define morsel_fe_cut_quadrature_h

#include <morsel/fe/cell_geometry.h>
#include <morsel/fracture/crack.h>

#include <vector>

namespace Morsel::FE
{
  using Polygon = std::vector<dealii::Point<2>>;


  /// Quadrature of one cell in physical coordinates.
  struct CellQuadrature
  {
    std::vector<dealii::Point<2>> points;    ///< [m]
    std::vector<dealii::Point<2>> reference; ///< the same on the unit square
    std::vector<double>           weights;   ///< with the area element [m^2]
  };


  /// Area of a counter-clockwise polygon [m^2].
  double
  polygon_area(const Polygon &polygon);


  /// Cuts a convex polygon along the line through a and b: the part to the
  /// left of the line and the part to its right, either of them perhaps
  /// empty. Corners closer to the line than @p tolerance [m] lie on it.
  std::pair<Polygon, Polygon>
  cut_polygon(const Polygon          &polygon,
              const dealii::Point<2> &a,
              const dealii::Point<2> &b,
              const double            tolerance);


  /// Distance from a crack to a convex polygon, 0 where they meet [m].
  double
  distance_to_polygon(const Fracture::Crack &crack, const Polygon &polygon);


  /// Distance from a point to a convex polygon, 0 inside [m].
  double
  distance_to_polygon(const dealii::Point<2> &p, const Polygon &polygon);


  /// The convex pieces into which the lines of those crack segments that
  /// enter the polygon divide it (one piece if none does). At a tip the line
  /// is carried on through the whole cell.
  std::vector<Polygon>
  cut_into_pieces(const Polygon                      &polygon,
                  const std::vector<Fracture::Crack> &cracks);


  /// Tensor Gauss rule with n points per direction.
  CellQuadrature
  gauss_quadrature(const QuadMap &map, const unsigned int n);


  /// Quadrature over pieces of a cell: collapsed Gauss rules of n points per
  /// direction on triangles; where a tip lies in a piece or closer to it than
  /// the piece is wide, fans of triangles about the point nearest to the tip,
  /// graded towards it, that integrate r^(-1) and r^(-1/2) times polynomials.
  CellQuadrature
  cut_quadrature(const QuadMap                       &map,
                 const std::vector<Polygon>          &pieces,
                 const std::vector<dealii::Point<2>> &tips,
                 const unsigned int                   n);


  /// One-dimensional Gauss rule on (0,1), tabulated once.
  struct GaussRule
  {
    std::vector<double> points, weights;
  };
  const GaussRule &
  gauss_rule(const unsigned int n);
} // namespace Morsel::FE

#endif
