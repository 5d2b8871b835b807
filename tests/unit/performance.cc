#include <morsel/measure/masticatory_performance.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Morsel::Measure;

namespace
{
  Fragment
  square(const double side)
  {
    Fragment fragment;
    fragment.area      = side * side;
    fragment.perimeter = 4. * side;
    return fragment;
  }
} // namespace


BOOST_AUTO_TEST_CASE(masticatory_performance_of_squares)
{
  // A block of 10 mm into four of 5 mm: S1 = 0.4, S2 = 0.8 per mm.
  const auto four = masticatory_performance(
      {square(0.010)}, std::vector<Fragment>(4, square(0.005)));
  BOOST_CHECK_CLOSE(four.largest_fragment, std::sqrt(0.4), 1e-10);
  BOOST_CHECK_CLOSE(four.all_fragments, std::sqrt(0.4), 1e-10);

  // One of 8 mm and nine of 2 mm.
  std::vector<Fragment> mixed(9, square(0.002));
  mixed.push_back(square(0.008));
  const auto result = masticatory_performance({square(0.010)}, mixed);
  BOOST_CHECK_CLOSE(result.largest_fragment, std::sqrt(0.5 - 0.4), 1e-10);
  BOOST_CHECK_CLOSE(
      result.all_fragments, std::sqrt((32. + 72.) / (64. + 36.) - 0.4), 1e-10);

  // Whole food, and none left.
  BOOST_CHECK_EQUAL(
      masticatory_performance({square(0.01)}, {square(0.01)}).all_fragments,
      0.);
  BOOST_CHECK_EQUAL(
      masticatory_performance({square(0.01)}, {}).largest_fragment, 0.);
}
