#ifndef morsel_fracture_tip_fields_h
#define morsel_fracture_tip_fields_h

#include <morsel/fracture/crack.h>
#include <morsel/fracture/elastic_plane.h>

#include <array>

namespace Morsel::Fracture
{
  /// A scalar function and its gradient at one point.
  struct ValueAndGradient
  {
    double               value = 0.;
    dealii::Tensor<1, 2> gradient; ///< in global coordinates
  };


  /// The four tip functions of XFEM (T3-18), in this order:
  /// sqrt(r) {sin(t/2), cos(t/2), sin(t/2) sin t, cos(t/2) sin t}.
  /// The first one jumps across the crack (t = +-pi).
  /// @pre @p p is not the tip itself.
  std::array<ValueAndGradient, 4>
  tip_functions(const CrackTip &tip, const dealii::Point<2> &p);


  /// A displacement and its gradient H_ij = du_i/dx_j at one point.
  struct DisplacementSample
  {
    dealii::Tensor<1, 2> value;    ///< [m]
    dealii::Tensor<2, 2> gradient; ///< [1]
  };


  /// Williams' field of a traction-free crack, the r^(1/2) term
  /// (Williams 1957).
  /// @param stress_intensity_I, stress_intensity_II [Pa sqrt(m)]
  /// @param local_frame components along the tip's axes instead of the
  ///   global ones
  DisplacementSample
  williams_field(const CrackTip         &tip,
                 const ElasticPlane     &material,
                 const double            stress_intensity_I,
                 const double            stress_intensity_II,
                 const dealii::Point<2> &p,
                 const bool              local_frame = false);


  /// Rotates a gradient H_ij from global components into the tip's frame.
  dealii::Tensor<2, 2>
  to_tip_frame(const CrackTip &tip, const dealii::Tensor<2, 2> &gradient);
} // namespace Morsel::Fracture

#endif
