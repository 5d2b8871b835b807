// Degrees that fall with the refinement level.
#include <morsel/fe/plate_problem.h>

#include <boost/test/unit_test.hpp>

#include "cracked_plate.h"

#include <cmath>

BOOST_AUTO_TEST_SUITE(xfem_degrees)

BOOST_AUTO_TEST_CASE(fewer_unknowns_for_the_same_stress_intensity)
{
  // Hanging faces between degrees at the corners, hanging faces with
  // enrichments at the tip. Without a common degree there, K is lost.
  using namespace Morsel::FE;
  PlateParameters p    = edge_crack('a');
  p.degree             = 5;
  p.enrichment_radius  = 5e-4;
  p.tip_refinements    = 1;
  p.corner_refinements = 8;
  const auto uniform   = solve(p);
  p.degree_drop        = 0.5;
  const auto falling   = solve(p);
  BOOST_TEST(falling.solve.n_dofs < 0.92 * uniform.solve.n_dofs);
  BOOST_TEST(falling.solve.n_dropped_pivots == 0u);
  const double K = falling.tips[0].statistics.mean.mode_I;
  BOOST_TEST(std::abs(K / 64.43520 - 1.) < 1e-6);
  // A conforming space never exceeds the energy, 4.61504923e-6 J/m.
  BOOST_TEST(falling.strain_energy < uniform.strain_energy);
  BOOST_TEST(falling.strain_energy > 4.61504923e-6 * (1. - 1e-6));
}

BOOST_AUTO_TEST_SUITE_END()
