#ifndef morsel_measure_masticatory_performance_h
#define morsel_measure_masticatory_performance_h

#include <morsel/measure/fragments.h>

#include <vector>

namespace Morsel::Measure
{
  /// Masticatory performance sqrt(|S2 - S1|) [1/sqrt(mm)], T4-4, where S is
  /// surface over volume [1/mm]: perimeter over area in two dimensions.
  struct MasticatoryPerformance
  {
    double largest_fragment = 0.; ///< S2 of the largest fragment (the thesis)
    double all_fragments    = 0.; ///< S2 of all of them together (Agrawal et
                                  ///< al., Arch. Oral Biol. 42 (1997) 1)
  };


  /// @param initial the blocks before they broke, with their perimeters by the
  ///   same estimator.
  /// @param fragments those that count; neither crumbs nor dust. 0 if there
  ///   are none: nothing is left whose surface could be measured.
  MasticatoryPerformance
  masticatory_performance(const std::vector<Fragment> &initial,
                          const std::vector<Fragment> &fragments);
} // namespace Morsel::Measure

#endif
