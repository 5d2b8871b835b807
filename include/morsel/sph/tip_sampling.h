#ifndef morsel_sph_tip_sampling_h
#define morsel_sph_tip_sampling_h

#include <morsel/fracture/interaction_integral.h>
#include <morsel/sph/discrete_gradient.h>

#include <string>
#include <vector>

namespace Morsel::SPH
{
  /// Stress intensity at one tip, ring by ring.
  struct TipResult
  {
    unsigned int                           tip = 0;
    std::vector<Fracture::Ring>            rings;
    std::vector<Fracture::StressIntensity> by_ring;
    std::vector<double>                    energy_release; ///< J [J/m^2]
    Fracture::RingStatistics               statistics;
    std::string                            remark; ///< empty if all is well
  };


  /// Three rings about a tip that stay clear of the boundary, kinks and other
  /// cracks.
  /// @param radius wished outer radius of the largest ring [m], 0: the
  ///   largest that fits
  /// @throws InputError if that one does not fit
  TipResult
  choose_rings(const Cloud                        &cloud,
               const std::vector<Fracture::Crack> &cracks,
               const Fracture::CrackTip           &tip,
               const double                        radius);


  /// Fills in K by the interaction integral. At the points of a polar Gauss
  /// rule the displacement gradient is the moving least-squares fit of the
  /// particles' own gradients on the side that the point sees.
  /// @param gradients H_i [1]
  void
  evaluate_rings(const ShapeFunctions         &shape,
                 const TensorField            &gradients,
                 const Fracture::ElasticPlane &material,
                 const Fracture::CrackTip     &tip,
                 TipResult                    &result);
} // namespace Morsel::SPH

#endif
