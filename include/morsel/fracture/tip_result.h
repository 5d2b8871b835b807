#ifndef morsel_fracture_tip_result_h
#define morsel_fracture_tip_result_h

#include <morsel/fracture/interaction_integral.h>

#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// Stress intensity at one tip, ring by ring, whatever method gave the
  /// field.
  struct TipResult
  {
    unsigned int                 tip = 0; ///< in the order of collect_tips()
    std::vector<Ring>            rings;
    std::vector<StressIntensity> by_ring;
    std::vector<double>          energy_release; ///< J_1 by ring [J/m^2]
    /// J_2 by ring [J/m^2]; empty unless it was asked for.
    std::vector<double> energy_release_across;
    RingStatistics      statistics;
    /// How many of the rings overlap the layer in which the functions that
    /// carry the singularity fade out.
    unsigned int n_rings_on_blending_layer = 0;
    /// What was wrong with the rings wished for; empty if nothing.
    std::string remark;
  };
} // namespace Morsel::Fracture

#endif
