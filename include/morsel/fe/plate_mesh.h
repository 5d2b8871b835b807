#ifndef morsel_fe_plate_mesh_h
#define morsel_fe_plate_mesh_h

#include <deal.II/base/point.h>

#include <deal.II/grid/tria.h>

#include <vector>

namespace Morsel::FE
{
  /// Boundary ids of a rectangular plate.
  struct PlateSide
  {
    static constexpr dealii::types::boundary_id left = 0, right = 1, bottom = 2,
                                                top = 3;
  };


  /// A rectangular plate of nx times ny cells, blind to any crack.
  /// @param shift moves the interior mesh lines by these shares of a cell, so
  ///   that a fixed crack takes any position relative to them; the plate
  ///   stays as it is
  void
  make_plate(dealii::Triangulation<2>   &triangulation,
             const dealii::Point<2>     &lower_corner,
             const dealii::Point<2>     &upper_corner,
             const unsigned int          nx,
             const unsigned int          ny,
             const dealii::Tensor<1, 2> &shift = dealii::Tensor<1, 2>());


  /// Geometric grading: @p n_levels times refines the cells that come nearer
  /// to the point than @p layers of their own diameter.
  void
  refine_towards(dealii::Triangulation<2> &triangulation,
                 const dealii::Point<2>   &point,
                 const unsigned int        n_levels,
                 const double              layers);
} // namespace Morsel::FE

#endif
