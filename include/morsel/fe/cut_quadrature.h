#ifndef morsel_fe_cut_quadrature_h
#define morsel_fe_cut_quadrature_h

#include <morsel/fe/cell_geometry.h>
#include <morsel/fe/polygon.h>

#include <vector>

namespace Morsel::FE
{
  /// Quadrature of one cell in physical coordinates.
  struct CellQuadrature
  {
    std::vector<dealii::Point<2>> points;    ///< [m]
    std::vector<dealii::Point<2>> reference; ///< the same on the unit square
    std::vector<double>           weights;   ///< with the area element [m^2]
  };


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
