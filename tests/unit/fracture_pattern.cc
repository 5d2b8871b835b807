// The direction of damage and the sizes of pieces, of patterns whose answers
// are known.
#include <morsel/measure/fracture_pattern.h>
#include <morsel/measure/fragment_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace Morsel::Measure;
using dealii::Point;

namespace
{
  /// A body of @p nx by @p ny particles, pressed along y.
  struct Body
  {
    Body(const unsigned int nx, const unsigned int ny)
        : spacing(1. / nx)
    {
      for (unsigned int y = 0; y < ny; ++y)
        for (unsigned int x = 0; x < nx; ++x)
          points.emplace_back((x + 0.5) * spacing, (y + 0.5) * spacing);
      areas.assign(points.size(), spacing * spacing);
      damage.assign(points.size(), 0.);
    }

    /// A band through @p through, @p degrees from y, as wide as some
    /// spacings.
    void
    add_band(const Point<2> &through, const double degrees, const double width)
    {
      const double a = degrees * 3.14159265358979 / 180.;
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const auto x = points[i] - through;
          if (std::abs(std::cos(a) * x[0] - std::sin(a) * x[1]) <
              0.5 * width * spacing)
            damage[i] = 1.;
        }
    }

    /// Spots of a few particles at random.
    void
    add_dust(const unsigned int n, const double radius, const unsigned int seed)
    {
      std::mt19937 generator(seed);
      for (unsigned int k = 0; k < n; ++k)
        {
          const Point<2> &middle = points[generator() % points.size()];
          for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i].distance(middle) < radius * spacing)
              damage[i] = 1.;
        }
    }

    FracturePattern
    pattern(const unsigned int axis = 1) const
    {
      const auto found = fracture_pattern(dealii::make_array_view(points),
                                          dealii::make_array_view(areas),
                                          dealii::make_array_view(damage),
                                          axis,
                                          spacing);
      BOOST_REQUIRE(found.has_value());
      BOOST_TEST_MESSAGE("angle " << found->angle << ", sharpness "
                                  << found->sharpness << ", explained "
                                  << found->explained << ", damaged "
                                  << found->damaged_share);
      return *found;
    }

    double                spacing;
    std::vector<Point<2>> points;
    std::vector<double>   areas, damage;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(fracture_patterns)


BOOST_AUTO_TEST_CASE(a_band_at_thirty_degrees)
{
  for (const unsigned int n : {30u, 100u})
    for (const double side : {-1., 1.})
      {
        Body body(n, n);
        body.add_band({0.5, 0.45}, side * 30., 4.);
        const auto found = body.pattern();
        BOOST_TEST(std::abs(found.angle - 30.) <= 2.);
        BOOST_TEST(found.sharpness > 0.5);
        // The same band of a body that is pressed along x.
        BOOST_TEST(std::abs(body.pattern(0).angle - 60.) <= 2.);
      }
}


BOOST_AUTO_TEST_CASE(axial_splits_count_together)
{
  Body body(60, 80);
  body.add_band({0.3, 0.}, 0., 2.);
  body.add_band({0.52, 0.}, 0., 2.);
  body.add_band({0.8, 0.}, 0., 3.);
  const auto found = body.pattern();
  BOOST_TEST(found.angle <= 1.);
  BOOST_TEST(found.sharpness > 0.5);
}


BOOST_AUTO_TEST_CASE(a_band_among_dust_and_a_crossing_one)
{
  Body dusty(100, 100);
  dusty.add_band({0.5, 0.5}, 25., 4.);
  dusty.add_dust(60, 2., 3);
  const auto found = dusty.pattern();
  BOOST_TEST(std::abs(found.angle - 25.) <= 3.);
  BOOST_TEST(found.sharpness > 0.15);

  Body crossed(100, 100);
  crossed.add_band({0.5, 0.5}, 35., 4.);
  crossed.add_band({0.5, 0.5}, -35., 4.);
  const auto both = crossed.pattern();
  BOOST_TEST(std::abs(both.angle - 35.) <= 2.);
  BOOST_TEST(both.sharpness > 0.2);
}


BOOST_AUTO_TEST_CASE(dust_has_no_direction)
{
  for (const unsigned int seed : {1u, 2u, 3u, 4u})
    for (const unsigned int n : {10u, 40u, 160u})
      {
        Body body(100, 100);
        body.add_dust(n, 2., seed);
        BOOST_TEST(body.pattern().sharpness < 0.05);
      }
}


BOOST_AUTO_TEST_CASE(a_whole_body_has_no_pattern)
{
  const Body body(20, 20);
  BOOST_TEST(!fracture_pattern(dealii::make_array_view(body.points),
                               dealii::make_array_view(body.areas),
                               dealii::make_array_view(body.damage),
                               1,
                               body.spacing));
}


BOOST_AUTO_TEST_CASE(sizes_of_pieces)
{
  // Pieces of 40, 30 and 10 % of 1 m^2; the rest is dust.
  Fragments fragments;
  for (const double share : {0.4, 0.3, 0.1})
    {
      Fragment piece;
      piece.share = piece.area = share;
      fragments.pieces.push_back(piece);
    }
  fragments.dust_share = 0.2;
  const auto   sizes   = fragment_sizes(fragments, {0.1, 0.5, 0.6, 0.7});
  const double whole   = equivalent_diameter(1.);
  BOOST_TEST(whole == 2. / std::sqrt(3.14159265358979),
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(sizes.median == std::sqrt(0.3) * whole,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(sizes.mass_weighted_mean ==
                 whole * (std::pow(0.4, 1.5) + std::pow(0.3, 1.5) +
                          std::pow(0.1, 1.5)),
             boost::test_tools::tolerance(1e-12));
  const std::vector<unsigned int> above = {3, 2, 1, 0};
  BOOST_TEST(sizes.count_above == above, boost::test_tools::per_element());

  BOOST_TEST(fragment_sizes({}, {0.1}).median == 0.);
}

BOOST_AUTO_TEST_SUITE_END()
