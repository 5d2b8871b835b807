// The perimeter estimator on discs and turned squares, of pixels and of
// scattered particles. The errors that its documentation states are the bands
// checked here.
#include <morsel/measure/perimeter.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>

using namespace Morsel::Measure;
using dealii::Point;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  using Inside = std::function<bool(double, double)>;


  Inside
  disc(const double radius, const Point<2> &centre)
  {
    return [=](const double x, const double y) {
      return std::hypot(x - centre[0], y - centre[1]) < radius;
    };
  }


  Inside
  square(const double half, const Point<2> &centre, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return [=](const double x, const double y) {
      const double u = x - centre[0], v = y - centre[1];
      return std::max(std::abs(c * u + s * v), std::abs(c * v - s * u)) < half;
    };
  }


  /// The perimeter by particles of spacing 1 inside the shape, which fits in
  /// |x|, |y| < size; each displaced by up to @p scatter.
  double
  measure(const Inside &inside,
          const int     size,
          const double  scatter,
          std::mt19937 &random)
  {
    std::uniform_real_distribution<double> shift(-scatter, scatter);
    // A scattered cloud must not know the axes.
    const double          angle = scatter > 0. ? 0.5 : 0.;
    const double          c = std::cos(angle), s = std::sin(angle);
    std::vector<Point<2>> points;
    for (int j = -2 * size; j < 2 * size; ++j)
      for (int i = -2 * size; i < 2 * size; ++i)
        {
          const double u = i + 0.5 + shift(random), v = j + 0.5 + shift(random);
          const Point<2> p(c * u - s * v, s * u + c * v);
          if (inside(p[0], p[1]))
            points.push_back(p);
        }
    const std::vector<double> areas(points.size(), 1.);
    return perimeter(
        dealii::make_array_view(points), dealii::make_array_view(areas), 1.);
  }


  struct Errors
  {
    double mean = 0., worst = 0.;
  };


  /// Relative errors over several places of the shape on the lattice.
  Errors
  errors(const std::function<Inside(const Point<2> &)> &shape,
         const double                                   exact,
         const int                                      across,
         const double                                   scatter)
  {
    std::mt19937                           random(across);
    std::uniform_real_distribution<double> place(-0.5, 0.5);
    constexpr int                          n = 8;
    Errors                                 result;
    for (int i = 0; i < n; ++i)
      {
        const Point<2> centre(place(random), place(random));
        const double   error =
            measure(shape(centre), across, scatter, random) / exact - 1.;
        result.mean += error / n;
        result.worst = std::max(result.worst, std::abs(error));
      }
    return result;
  }


  void
  report(const std::string &what, const int across, const Errors &e)
  {
    if (std::getenv("MORSEL_TABLES"))
      std::cout << what << " " << across << " across: mean " << 100. * e.mean
                << " %, worst " << 100. * e.worst << " %" << std::endl;
  }


  struct Case
  {
    int    across;
    double mean, worst; ///< allowed, relative
  };
} // namespace


BOOST_AUTO_TEST_SUITE(perimeters)


BOOST_AUTO_TEST_CASE(squares_along_the_axes)
{
  std::mt19937 random(1);
  for (const Case c : {Case{6, 0.008, 0.008},
                       Case{10, 0.003, 0.003},
                       Case{20, 0.0006, 0.0006},
                       Case{50, 0.0001, 0.0001},
                       Case{100, 0.00003, 0.00003}})
    {
      const double centre = c.across % 2 == 0 ? 0. : 0.5;
      const double p      = measure(
          square(0.5 * c.across, {centre, centre}, 0.), c.across, 0., random);
      report("aligned square", c.across, {p / (4. * c.across) - 1., 0.});
      BOOST_CHECK_LE(std::abs(p / (4. * c.across) - 1.), c.worst);
    }
}


BOOST_AUTO_TEST_CASE(discs)
{
  for (const Case c : {Case{6, 0.05, 0.11},
                       Case{10, 0.03, 0.05},
                       Case{20, 0.015, 0.025},
                       Case{50, 0.005, 0.007},
                       Case{100, 0.003, 0.003}})
    {
      const auto e =
          errors([&](const auto &o) { return disc(0.5 * c.across, o); },
                 pi * c.across,
                 c.across,
                 0.);
      report("disc", c.across, e);
      BOOST_CHECK_LE(std::abs(e.mean), c.mean);
      BOOST_CHECK_LE(e.worst, c.worst);
    }
}


BOOST_AUTO_TEST_CASE(turned_squares)
{
  for (const Case c : {Case{6, 0.06, 0.15},
                       Case{10, 0.04, 0.12},
                       Case{20, 0.025, 0.05},
                       Case{50, 0.012, 0.025},
                       Case{100, 0.008, 0.01}})
    for (const double degrees : {5., 10., 15., 22.5, 30., 40., 45.})
      {
        const auto e = errors(
            [&](const auto &o) {
              return square(0.5 * c.across, o, degrees * pi / 180.);
            },
            4. * c.across,
            c.across,
            0.);
        report("square at " + std::to_string(degrees), c.across, e);
        BOOST_CHECK_LE(std::abs(e.mean), c.mean);
        BOOST_CHECK_LE(e.worst, c.worst);
      }
}


BOOST_AUTO_TEST_CASE(scattered_particles)
{
  for (const Case c : {Case{6, 0.12, 0.2},
                       Case{10, 0.08, 0.12},
                       Case{20, 0.05, 0.08},
                       Case{50, 0.04, 0.06}})
    {
      const auto d =
          errors([&](const auto &o) { return disc(0.5 * c.across, o); },
                 pi * c.across,
                 c.across,
                 0.2);
      report("scattered disc", c.across, d);
      const auto s =
          errors([&](const auto &o) { return square(0.5 * c.across, o, 0.3); },
                 4. * c.across,
                 c.across,
                 0.2);
      report("scattered square", c.across, s);
      const auto a = errors(
          [&](const auto &) {
            return square(0.5 * c.across, {0., 0.}, 0.);
          },
          4. * c.across,
          c.across,
          0.2);
      report("scattered aligned square", c.across, a);
      for (const auto &e : {d, s, a})
        {
          BOOST_CHECK_LE(std::abs(e.mean), c.mean);
          BOOST_CHECK_LE(e.worst, c.worst);
        }
    }
}


BOOST_AUTO_TEST_CASE(holes_and_touching_corners)
{
  // A frame of 9 x 9 with a hole of 3 x 3: both boundaries count.
  std::vector<std::array<int, 2>> frame;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x)
      if (std::max(std::abs(x - 4), std::abs(y - 4)) > 1)
        frame.push_back({{x, y}});
  BOOST_CHECK_CLOSE(perimeter_of_pixels(frame), 36. + 12., 2.);

  // Two squares that meet at a corner count as two.
  std::vector<std::array<int, 2>> one, two;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      {
        one.push_back({{x, y}});
        two.push_back({{x, y}});
        two.push_back({{x + 8, y + 8}});
      }
  BOOST_CHECK_CLOSE(
      perimeter_of_pixels(two), 2. * perimeter_of_pixels(one), 1e-10);
  BOOST_CHECK_EQUAL(perimeter_of_pixels({}), 0.);
  BOOST_CHECK_GT(perimeter_of_pixels({{{0, 0}}}), 2.);
}


BOOST_AUTO_TEST_CASE(units_and_offsets)
{
  // 10 mm wide, 101 particles: the food block of the scenes.
  const double          dp = 0.01 / 101.;
  std::vector<Point<2>> points;
  for (int y = 0; y < 101; ++y)
    for (int x = 0; x < 101; ++x)
      points.emplace_back(0.003 + (x + 0.5) * dp, -0.007 + (y + 0.5) * dp);
  const std::vector<double> areas(points.size(), dp * dp);
  BOOST_CHECK_CLOSE(perimeter(dealii::make_array_view(points),
                              dealii::make_array_view(areas),
                              dp),
                    0.04,
                    0.01);
}


BOOST_AUTO_TEST_SUITE_END()
