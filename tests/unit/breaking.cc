// Proves: the growth of a crack is followed through what fails in connection
// with its tip and nothing else, with its speed and its branches; and the speed
// of Rayleigh waves is the known one.
#include <morsel/measure/crack_growth.h>

#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

using namespace Morsel;

namespace
{
  constexpr double spacing = 1e-3;

  SPH::Solid
  breakable_block(const unsigned int nx, const unsigned int ny)
  {
    Scene::Scene scene = SPH::scene_of_block(nx, ny, spacing, 0.3);
    scene.particle_bodies.front().damage.enabled = true;
    return SPH::make_solid(scene);
  }


  /// The particle in a column and a row, marked as failed.
  unsigned int
  fail(SPH::Solid        &solid,
       const unsigned int column,
       const unsigned int row,
       const unsigned int nx)
  {
    const unsigned int i           = row * nx + column;
    SPH::state_of(solid).failed[i] = 1;
    return i;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(breaking)

BOOST_AUTO_TEST_CASE(speed_of_rayleigh_waves)
{
  // Poisson's solid: (c_R/c_s)^2 = 2 - 2/sqrt(3).
  const Materials::Elasticity poisson(1e7, 0.25, 1000.);
  BOOST_CHECK_CLOSE(Measure::rayleigh_speed(poisson),
                    std::sqrt((2. - 2. / std::sqrt(3.)) * poisson.mu / 1000.),
                    1e-9);
  // The glass of the branching crack.
  BOOST_CHECK_CLOSE(
      Measure::rayleigh_speed(Materials::Elasticity(32e9, 0.2, 2450.)),
      2125.,
      0.05);
}


BOOST_AUTO_TEST_CASE(crack_goes_on_from_its_tip)
{
  constexpr unsigned int nx = 40, ny = 20;
  SPH::Solid             solid = breakable_block(nx, ny);
  // The tip stands in front of column 5.
  Measure::CrackGrowth crack(solid, {5. * spacing, 10. * spacing});
  // Ten spacings ahead: not in touch.
  crack.follow(0., {fail(solid, 15, 10, nx)});
  BOOST_TEST(crack.extension() == 0.);
  BOOST_TEST(!crack.start());
  // Column by column at 100 m/s until it meets what has failed before.
  for (unsigned int k = 5; k < 13; ++k)
    crack.follow((k - 4) * 1e-5, {fail(solid, k, 10, nx)});
  BOOST_CHECK_CLOSE(crack.extension(), std::hypot(7.5, 0.5) * spacing, 1e-9);
  BOOST_CHECK_CLOSE(*crack.start(), 1e-5, 1e-9);
  BOOST_TEST(crack.speed(8e-5) == 0.); // shorter than ten spacings
  crack.follow(9e-5, {fail(solid, 13, 10, nx)});
  BOOST_CHECK_CLOSE(crack.extension(), std::hypot(10.5, 0.5) * spacing, 1e-9);
  for (unsigned int k = 16; k < 30; ++k)
    crack.follow((k - 4) * 1e-5, {fail(solid, k, 10, nx)});
  BOOST_CHECK_CLOSE(crack.speed(25e-5), 100., 5.);
  BOOST_TEST(crack.largest_speed() >= crack.speed(25e-5));
  BOOST_TEST(crack.speed(50e-5) < crack.speed(25e-5)); // it stands
  BOOST_TEST(crack.branch_count() == 1u);
}


BOOST_AUTO_TEST_CASE(branches_are_counted)
{
  constexpr unsigned int    nx = 40, ny = 40;
  SPH::Solid                solid = breakable_block(nx, ny);
  Measure::CrackGrowth      crack(solid, {0., 20. * spacing});
  std::vector<unsigned int> failed;
  for (unsigned int k = 0; k < 15; ++k)
    failed.push_back(fail(solid, k, 20, nx));
  for (unsigned int k = 0; k < 15; ++k)
    {
      failed.push_back(fail(solid, 15 + k, 20 + k, nx));
      failed.push_back(fail(solid, 15 + k, 20 - k, nx));
    }
  crack.follow(1e-5, failed);
  BOOST_TEST(crack.branch_count() == 2u);
}

BOOST_AUTO_TEST_SUITE_END()
