#include <morsel/measure/masticatory_performance.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Measure
{
  namespace
  {
    /// Perimeter over area of all pieces together [1/mm].
    double
    specific_surface(const std::vector<Fragment> &pieces)
    {
      double perimeter = 0., area = 0.;
      for (const auto &piece : pieces)
        {
          perimeter += piece.perimeter;
          area += piece.area;
        }
      constexpr double per_mm = 1e-3; // 1/m in 1/mm
      return per_mm * perimeter / area;
    }
  } // namespace


  MasticatoryPerformance
  masticatory_performance(const std::vector<Fragment> &initial,
                          const std::vector<Fragment> &fragments)
  {
    AssertThrow(!initial.empty(), dealii::ExcMessage("No food to begin with."));
    MasticatoryPerformance result;
    if (fragments.empty())
      return result;

    const double S1      = specific_surface(initial);
    const auto   largest = *std::max_element(
        fragments.begin(), fragments.end(), [](const auto &a, const auto &b) {
          return a.area < b.area;
        });
    result.largest_fragment =
        std::sqrt(std::abs(specific_surface({largest}) - S1));
    result.all_fragments =
        std::sqrt(std::abs(specific_surface(fragments) - S1));
    return result;
  }
} // namespace Morsel::Measure
