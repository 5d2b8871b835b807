#ifndef morsel_sph_tip_sampling_h
#define morsel_sph_tip_sampling_h

#include <morsel/fracture/plate_output.h>
#include <morsel/fracture/tip_result.h>
#include <morsel/sph/discrete_gradient.h>

#include <vector>

namespace Morsel::SPH
{
  /// Three rings about a tip that stay clear of the boundary, kinks and other
  /// cracks.
  /// @param radius wished outer radius of the largest ring [m], 0: the
  ///   largest that fits
  /// @throws InputError if that one does not fit
  Fracture::TipResult
  choose_rings(const Cloud                        &cloud,
               const std::vector<Fracture::Crack> &cracks,
               const Fracture::CrackTip           &tip,
               const double                        radius);


  /// Fills in K by the interaction integral over the points of a polar Gauss
  /// rule.
  /// @param spacing   of the particles [m]
  /// @param both_components J_2 of the J vector, too
  void
  evaluate_rings(const Fracture::FieldSampler &sample,
                 const Fracture::ElasticPlane &material,
                 const Fracture::CrackTip     &tip,
                 const double                  spacing,
                 const bool                    both_components,
                 Fracture::TipResult          &result);


  /// Displacements of a cloud and the particles' own gradients of them.
  struct CloudField
  {
    const ShapeFunctions &shape;
    const VectorField    &displacement; ///< [m]
    const TensorField    &gradients;    ///< H_i [1]

    /// The moving least-squares fits of both at @p x on the side that
    /// @p eye sees.
    Fracture::DisplacementSample
    sample_from(const dealii::Point<2> &eye, const dealii::Point<2> &x) const;

    /// The same at points that see for themselves.
    std::vector<Fracture::DisplacementSample>
    sample(const std::vector<dealii::Point<2>> &points) const;
  };


  /// K at all tips, over the largest rings that fit or the one wished for.
  /// @throws InputError if that one does not fit
  std::vector<Fracture::TipResult>
  evaluate_tips(const CloudField                   &field,
                const std::vector<Fracture::Crack> &cracks,
                const Fracture::ElasticPlane       &material,
                const double                        ring_radius,
                const bool                          both_components);
} // namespace Morsel::SPH

#endif
