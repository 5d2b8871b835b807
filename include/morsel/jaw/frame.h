#ifndef morsel_jaw_frame_h
#define morsel_jaw_frame_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <cmath>

namespace Morsel::Jaw
{
  /// How a plate stands and moves as a whole: what was at X at first is at
  /// pivot + shift + R(angle) (X - pivot).
  struct Frame
  {
    dealii::Point<2>     pivot;      ///< [m]
    dealii::Tensor<1, 2> shift;      ///< of the pivot [m]
    double               angle = 0.; ///< anticlockwise [rad]
    dealii::Tensor<1, 2> velocity;   ///< of the pivot [m/s]
    double               spin = 0.;  ///< [rad/s]

    dealii::Tensor<2, 2>
    orientation() const
    {
      dealii::Tensor<2, 2> r;
      r[0][0] = r[1][1] = std::cos(angle);
      r[1][0]           = std::sin(angle);
      r[0][1]           = -r[1][0];
      return r;
    }

    dealii::Point<2>
    place(const dealii::Point<2> &reference) const
    {
      return place(reference, orientation());
    }

    /// The same for many points.
    /// @param R orientation()
    dealii::Point<2>
    place(const dealii::Point<2>     &reference,
          const dealii::Tensor<2, 2> &R) const
    {
      return angle == 0. ? reference + shift
                         : pivot + shift + R * (reference - pivot);
    }

    /// Of the body at a place where it stands now [m/s].
    dealii::Tensor<1, 2>
    velocity_at(const dealii::Point<2> &place) const
    {
      if (spin == 0.)
        return velocity;
      const auto arm = place - (pivot + shift);
      return velocity + spin * dealii::Tensor<1, 2>({-arm[1], arm[0]});
    }
  };


  /// z component of the product of two vectors in the plane.
  inline double
  cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }
} // namespace Morsel::Jaw

#endif
