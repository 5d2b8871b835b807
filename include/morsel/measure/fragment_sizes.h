#ifndef morsel_measure_fragment_sizes_h
#define morsel_measure_fragment_sizes_h

#include <morsel/measure/fragments.h>

#include <vector>

namespace Morsel::Measure
{
  /// Diameter of the circle of the same area [m].
  double
  equivalent_diameter(double area);


  /// How large the pieces of broken food are, fragments and crumbs; what has
  /// failed (dust) counts as mass without size.
  struct FragmentSizes
  {
    /// Mean diameter, each piece weighted with its mass; dust counts as 0
    /// [m].
    double mass_weighted_mean = 0.;

    /// Half of the food's mass is in pieces that are not larger (dust among
    /// it) [m].
    double median = 0.;

    /// Pieces of a larger diameter than each of the shares of the whole
    /// food's [1].
    std::vector<unsigned int> count_above;
  };

  /// @param shares of the diameter of the whole food [1]
  FragmentSizes
  fragment_sizes(const Fragments &fragments, const std::vector<double> &shares);
} // namespace Morsel::Measure

#endif
