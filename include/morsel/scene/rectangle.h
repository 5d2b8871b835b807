#ifndef morsel_scene_rectangle_h
#define morsel_scene_rectangle_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

namespace Morsel::Scene
{
  /// An axis-parallel rectangle [m].
  struct Rectangle
  {
    dealii::Point<2> lower_corner;
    dealii::Point<2> upper_corner;

    void
    declare(dealii::ParameterHandler &prm);

    /// Extent in a direction [m].
    double
    extent(unsigned int direction) const
    {
      return upper_corner[direction] - lower_corner[direction];
    }

    bool
    contains(const dealii::Point<2> &x) const
    {
      return x[0] >= lower_corner[0] && x[0] <= upper_corner[0] &&
             x[1] >= lower_corner[1] && x[1] <= upper_corner[1];
    }
  };
} // namespace Morsel::Scene

#endif
