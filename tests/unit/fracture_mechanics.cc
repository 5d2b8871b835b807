// Crack geometry, tip fields, the interaction integral on exact fields and
// the energy route: what finite elements and particles share.
#include <morsel/core/errors.h>
#include <morsel/fracture/crack.h>
#include <morsel/fracture/energy_release.h>
#include <morsel/fracture/interaction_integral.h>
#include <morsel/fracture/tip_fields.h>

#include <deal.II/base/numbers.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

namespace
{
  using namespace Morsel::Fracture;
  using dealii::Point;
  using dealii::Tensor;

  const ElasticPlane steel_like(10e6, 0.3);

  CrackTip
  inclined_tip(const double angle)
  {
    const Crack crack(
        {Point<2>(-std::cos(angle), -std::sin(angle)), Point<2>(0., 0.)},
        false,
        true);
    return crack.tips()[0];
  }


  /// K of Williams' field by the interaction integral over polar points.
  StressIntensity
  integral_of_williams_field(const CrackTip &tip,
                             const double    K_I,
                             const double    K_II)
  {
    InteractionIntegral integral(tip, steel_like, {0.2, 0.9});
    const unsigned int  n_r = 400, n_t = 400;
    for (unsigned int i = 0; i < n_r; ++i)
      for (unsigned int j = 0; j < n_t; ++j)
        {
          const double   r  = 0.2 + 0.7 * (i + 0.5) / n_r;
          const double   dt = 2. * dealii::numbers::PI / n_t;
          const double   t  = -dealii::numbers::PI + (j + 0.5) * dt;
          const double   t0 = std::atan2(tip.direction[1], tip.direction[0]);
          const Point<2> p =
              tip.position +
              Tensor<1, 2>({r * std::cos(t + t0), r * std::sin(t + t0)});
          const auto u = williams_field(tip, steel_like, K_I, K_II, p);
          integral.add(
              p, u.gradient, steel_like.stress(u.gradient), r * dt * 0.7 / n_r);
        }
    return integral.stress_intensity();
  }
} // namespace


BOOST_AUTO_TEST_SUITE(fracture_mechanics)

BOOST_AUTO_TEST_CASE(side_of_a_straight_crack)
{
  const Crack crack({Point<2>(0, 0), Point<2>(1, 0)}, false, true);
  BOOST_TEST(crack.signed_distance(Point<2>(0.5, 0.2)) == 0.2);
  BOOST_TEST(crack.signed_distance(Point<2>(0.5, -0.2)) == -0.2);
  // Beyond the tip its line goes on.
  BOOST_TEST(crack.signed_distance(Point<2>(2., 1e-12)) > 0.);
  BOOST_TEST(crack.signed_distance(Point<2>(2., -1e-12)) < 0.);
  BOOST_TEST(crack.distance(Point<2>(2., 0.)) == 1.);
  BOOST_TEST(crack.length() == 1.);
}

BOOST_AUTO_TEST_CASE(side_of_a_kinked_crack)
{
  const Crack crack(
      {Point<2>(0, 0), Point<2>(1, 0), Point<2>(1, 1)}, true, true);
  BOOST_TEST(crack.signed_distance(Point<2>(0.5, 0.5)) > 0.);
  BOOST_TEST(crack.signed_distance(Point<2>(1.5, -0.5)) < 0.);
  BOOST_TEST(crack.signed_distance(Point<2>(1.01, -1e-9)) < 0.);
  const auto tips = crack.tips();
  BOOST_TEST(tips.size() == 2u);
  BOOST_TEST(tips[0].direction[0] == -1.);
  BOOST_TEST(tips[1].direction[1] == 1.);
  BOOST_TEST(tips[1].segment == 1.);
}

BOOST_AUTO_TEST_CASE(visibility)
{
  const Crack crack({Point<2>(0, 0), Point<2>(1, 0)}, false, true);
  BOOST_TEST(crack.separates(Point<2>(0.5, 0.1), Point<2>(0.5, -0.1)));
  BOOST_TEST(!crack.separates(Point<2>(1.5, 0.1), Point<2>(1.5, -0.1)));
  BOOST_TEST(!crack.separates(Point<2>(0.2, 0.1), Point<2>(0.8, 0.1)));
  BOOST_TEST(!crack.separates(Point<2>(0.2, 0.), Point<2>(0.8, 0.)));
  BOOST_TEST(
      crack.separates(Point<2>(0.999999, 1e-9), Point<2>(0.999999, -1e-9)));
}

BOOST_AUTO_TEST_CASE(bad_cracks_are_refused)
{
  using Morsel::InputError;
  BOOST_CHECK_THROW(Crack({Point<2>(0, 0)}, true, true), InputError);
  BOOST_CHECK_THROW(Crack({Point<2>(0, 0), Point<2>(0, 0)}, true, true),
                    InputError);
  BOOST_CHECK_THROW(
      Crack({Point<2>(0, 0), Point<2>(1, 0), Point<2>(1, 1), Point<2>(0.5, -1)},
            true,
            true),
      InputError);
}

BOOST_AUTO_TEST_CASE(crossing_cracks_have_no_distance)
{
  const Crack a({Point<2>(0, 0), Point<2>(1, 0)}, true, true);
  const Crack b({Point<2>(0.5, -1), Point<2>(0.5, 1)}, true, true);
  const Crack c({Point<2>(0, 0.25), Point<2>(1, 0.25)}, true, true);
  BOOST_TEST(a.distance(b) == 0.);
  BOOST_TEST(a.distance(c) == 0.25);
}

BOOST_AUTO_TEST_CASE(gradients_of_the_tip_functions)
{
  const CrackTip tip = inclined_tip(0.4);
  const Point<2> p(0.3, -0.2);
  const double   h = 1e-6;
  for (unsigned int k = 0; k < 4; ++k)
    for (unsigned int d = 0; d < 2; ++d)
      {
        Tensor<1, 2> e;
        e[d]               = h;
        const double slope = (tip_functions(tip, p + e)[k].value -
                              tip_functions(tip, p - e)[k].value) /
                             (2. * h);
        BOOST_TEST(std::abs(slope - tip_functions(tip, p)[k].gradient[d]) <
                   1e-9);
      }
}

BOOST_AUTO_TEST_CASE(williams_field_is_in_the_span_of_the_tip_functions)
{
  // u_y of mode I at t = +-pi jumps by 8 K/E' sqrt(r/2 pi).
  const CrackTip tip = inclined_tip(0.);
  const double   r   = 0.01;
  const auto up = williams_field(tip, steel_like, 1., 0., Point<2>(-r, 1e-14));
  const auto down =
      williams_field(tip, steel_like, 1., 0., Point<2>(-r, -1e-14));
  const double opening = 8. / steel_like.effective_modulus *
                         std::sqrt(r / (2. * dealii::numbers::PI));
  BOOST_TEST(up.value[1] - down.value[1] == opening,
             boost::test_tools::tolerance(1e-9));
  // The faces carry no traction.
  const auto stress = steel_like.stress(up.gradient);
  BOOST_TEST(std::abs(stress[1][1]) < 1e-9 / std::sqrt(r));
  BOOST_TEST(std::abs(stress[0][1]) < 1e-6 / std::sqrt(r));
}

BOOST_AUTO_TEST_CASE(interaction_integral_of_exact_fields)
{
  for (const double angle : {0., 0.7, -2.5})
    {
      const CrackTip tip = inclined_tip(angle);
      const auto     one = integral_of_williams_field(tip, 1., 0.);
      BOOST_TEST(std::abs(one.mode_I - 1.) < 1e-4);
      BOOST_TEST(std::abs(one.mode_II) < 1e-10);
      const auto both = integral_of_williams_field(tip, 2., -3.);
      BOOST_TEST(std::abs(both.mode_I - 2.) < 2e-4);
      BOOST_TEST(std::abs(both.mode_II + 3.) < 3e-4);
    }
}

BOOST_AUTO_TEST_CASE(rings_that_reach_something_are_refused)
{
  const Crack a({Point<2>(0, 0), Point<2>(1, 0)}, true, true);
  const Crack b({Point<2>(1.3, -1), Point<2>(1.3, 1)}, true, true);
  const auto  tip = a.tips()[1];
  BOOST_TEST(ring_obstacle(tip, {a}, 5., {0.1, 0.9}).empty());
  BOOST_TEST(!ring_obstacle(tip, {a}, 5., {0.1, 1.1}).empty());
  BOOST_TEST(!ring_obstacle(tip, {a}, 0.5, {0.1, 0.6}).empty());
  BOOST_TEST(!ring_obstacle(tip, {a, b}, 5., {0.1, 0.5}).empty());
  BOOST_TEST(largest_ring_radius(tip, {a, b}, 5.) == 0.3,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(energy_difference_and_two_directions)
{
  // U = a^2: dU/da = 2a; the one-sided formula is exact for parabolas.
  const double                a = 3., da = 0.25;
  const auto                  U = [](const double x) { return x * x; };
  const std::array<double, 3> energies{{U(a), U(a + da), U(a + 2. * da)}};
  BOOST_TEST(energy_difference(energies, da, HeldQuantity::traction) == 6.,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(energy_difference(energies, da, HeldQuantity::displacement) == -6.,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(stress_intensity_of_energy(-1., 1.) == 0.);
  const double E = 7., K1 = 2., K2 = -0.5;
  const auto   K =
      two_direction_recipe((K1 * K1 + K2 * K2) / E, -2. * K1 * K2 / E, E);
  BOOST_TEST(K.mode_I == K1, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(K.mode_II == K2, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
