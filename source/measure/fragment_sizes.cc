#include <morsel/measure/fragment_sizes.h>

#include <cmath>

namespace Morsel::Measure
{
  double
  equivalent_diameter(const double area)
  {
    constexpr double pi = 3.14159265358979323846;
    return std::sqrt(4. * area / pi);
  }


  FragmentSizes
  fragment_sizes(const Fragments &fragments, const std::vector<double> &shares)
  {
    FragmentSizes sizes;
    sizes.count_above.assign(shares.size(), 0);
    if (fragments.pieces.empty())
      return sizes;
    const Fragment &largest = fragments.pieces.front();
    const double    whole   = equivalent_diameter(largest.area / largest.share);
    double          larger  = 0.; // mass in larger pieces
    for (const Fragment &piece : fragments.pieces)
      {
        const double d = equivalent_diameter(piece.area);
        sizes.mass_weighted_mean += piece.share * d;
        larger += piece.share;
        if (sizes.median == 0. && larger >= 0.5)
          sizes.median = d;
        for (std::size_t k = 0; k < shares.size(); ++k)
          sizes.count_above[k] += d > shares[k] * whole;
      }
    return sizes;
  }
} // namespace Morsel::Measure
