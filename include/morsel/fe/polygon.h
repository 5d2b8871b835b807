#ifndef morsel_fe_polygon_h
#define morsel_fe_polygon_h

#include <morsel/fracture/crack.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <utility>
#include <vector>

namespace Morsel::FE
{
  /// Corners of a convex polygon, counter-clockwise [m].
  using Polygon = std::vector<dealii::Point<2>>;


  /// The third component of the cross product of two plane vectors.
  inline double
  cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }


  /// Largest distance between two corners [m].
  double
  polygon_diameter(const Polygon &polygon);


  /// The point of a polygon, its inside included, that is nearest to p.
  dealii::Point<2>
  nearest_in_polygon(const dealii::Point<2> &p, const Polygon &polygon);


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
} // namespace Morsel::FE

#endif
