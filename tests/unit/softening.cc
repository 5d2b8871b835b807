// Proves: energy softening lets the stress of a particle fall linearly in
// tension and in compression and takes the energy that it says, per area of
// crack whatever the spacing; flaws of each kind follow their distribution and
// do not depend on the particles that ask.
#include <morsel/materials/flaws.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace Morsel::Materials;
using boost::test_tools::tolerance;

namespace
{
  const Elasticity material(23.9e6, 0.3, 1088.);
  constexpr double strength = 101.2e3;

  DamageParameters
  tough(const double fracture_energy)
  {
    DamageParameters p;
    p.flaws           = "uniform";
    p.fracture_energy = fracture_energy;
    return p;
  }


  struct Curve
  {
    double peak       = 0.; ///< [Pa]
    double energy     = 0.; ///< under the curve until failure [J/m^3]
    double bend       = 0.; ///< largest distance from the straight fall [Pa]
    double end        = 0.; ///< strain where it fails [1]
    double dissipated = 0.; ///< what damage released [J/m^3]
  };


  /// Uniaxial stress along y in plane strain: the axial strain is prescribed,
  /// the lateral one makes the lateral stress vanish.
  Curve
  pull(const DamageLaw &law, const double sign, const double threshold)
  {
    const double last = 1.2 * law.range_at(threshold) * threshold * strength /
                        material.plane_strain_modulus() *
                        (sign > 0. ? law.tensile_strength / strength : 1.);
    constexpr int n = 20000;
    Curve         curve;
    Softened      state{0., 0.};
    double        before = 0.;
    for (int k = 1; k <= n && state.damage < 0.999; ++k)
      {
        const double e         = sign * last * k / n;
        const auto   stress_at = [&](const double lateral) {
          const double tr = e + lateral, third = tr / 3.;
          return ElasticResponse{
              1. + tr,
              {2. * material.mu * (lateral - third),
               2. * material.mu * (e - third),
               0.,
               -2. * material.mu * third},
              material.bulk * tr,
              material.mu * ((lateral - third) * (lateral - third) +
                             (e - third) * (e - third) + third * third),
              0.5 * material.bulk * tr * tr};
        };
        // Equilibrium at this strain: the lateral stress, linear in the
        // lateral strain on either side of zero volume change, vanishes by
        // two steps of the secant; then damage may grow, and so on.
        double x = -0.3 / 0.7 * e;
        for (int round = 0; round < 400; ++round)
          {
            for (int iteration = 0; iteration < 4; ++iteration)
              {
                const auto lateral = [&](const double strain) {
                  return soften(law.softening, stress_at(strain), state.damage)
                      .xx;
                };
                const double step = 1e-4 * std::abs(e);
                const double f = lateral(x), g = lateral(x + step);
                if (g == f)
                  break;
                x -= f * step / (g - f);
              }
            const ElasticResponse   r = stress_at(x);
            const PlaneStrainStress s = soften(law.softening, r, 0.);
            const double            energy =
                r.deviatoric_energy + (r.mean < 0. ? 0. : r.volumetric_energy);
            const Softened next = energy_softening(
                law, material, s, true, threshold, energy, state);
            const double growth = next.damage - state.damage;
            curve.dissipated += energy * growth;
            state = next;
            if (growth < 1e-7)
              break;
          }
        const double now =
            sign * soften(law.softening, stress_at(x), state.damage).yy;
        curve.peak = std::max(curve.peak, now);
        curve.energy += 0.5 * (before + now) * last / n;
        before    = now;
        curve.end = std::abs(e);
      }
    return curve;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(softening)

BOOST_AUTO_TEST_CASE(stress_falls_with_the_energy_in_tension_and_compression)
{
  const double E = material.plane_strain_modulus();
  for (const double r : {1., 0.7})
    for (const double G : {2e-3, 4e-3, 1e-2})
      {
        const double    dp = 1e-4;
        const DamageLaw law(tough(G), material, strength, {dp * dp, dp});
        const double    range = law.range_at(r);
        for (const double sign : {1., -1.})
          {
            const double f = r * (sign > 0. ? law.tensile_strength : strength);
            const Curve  curve = pull(law, sign, r);
            const double full  = range * f * f / (2. * E);
            BOOST_TEST_MESSAGE((sign > 0. ? "tension" : "compression")
                               << ", r = " << r << ", range " << range
                               << ": peak " << curve.peak / f << ", energy "
                               << curve.energy / full << ", dissipated "
                               << curve.dissipated / full << ", end "
                               << curve.end * E / (range * f));
            // D = 0.999 counts for one: a share of 0.001 range is left.
            const double left = 1. - 1e-3 * range;
            BOOST_TEST(curve.peak == f, tolerance(1e-3));
            BOOST_TEST(curve.energy == full, tolerance(5e-3));
            BOOST_TEST(curve.dissipated == full * left, tolerance(2e-2));
            BOOST_TEST(curve.end * E / f == range * left, tolerance(2e-2));
          }
        // Per area of a crack across the band: the same at every spacing.
        BOOST_TEST(range * std::pow(r * law.tensile_strength, 2) / (2. * E) *
                           DamageLaw::band_width * dp ==
                       G,
                   tolerance(1e-12));
      }
}


BOOST_AUTO_TEST_CASE(damage_stays_where_the_strength_is_not_reached)
{
  const DamageLaw law(tough(4e-3), material, strength, {1e-8, 1e-4});
  const Softened  state{0.3, 0.2};
  // The driver is linear in tension: (1 - D) sigma/f_t = r (1 - kappa).
  const double limit = 0.8 * law.tensile_strength / 0.7;
  const auto   at    = [&](const double sigma) {
    return energy_softening(
        law, material, {sigma, 0., 0., 0.3 * sigma}, true, 1., 100., state);
  };
  const Softened below = at(0.999 * limit), above = at(1.001 * limit);
  BOOST_TEST(below.damage == 0.3);
  BOOST_TEST(below.used == 0.2);
  BOOST_TEST(above.damage > 0.3);
  BOOST_TEST(above.used > 0.2);
}


BOOST_AUTO_TEST_CASE(what_stores_more_than_it_can_take_fails_at_once)
{
  const DamageLaw law(tough(4e-3), material, strength, {1e-8, 1e-4});
  const double    sigma = 2. * law.tensile_strength;
  const Softened  now   = energy_softening(
      law, material, {sigma, 0., 0., 0.3 * sigma}, true, 1., 1e9, {0., 0.});
  BOOST_TEST(now.damage == 1.);
  BOOST_TEST(now.used == 1.);
}


BOOST_AUTO_TEST_CASE(a_correlated_field_is_normal_and_correlated_as_told)
{
  // 100 x 100 places two lengths apart are independent but for 0.14.
  constexpr double      length = 5e-4;
  const CorrelatedField field(length, 3), other(length, 4);
  double                sum = 0., square = 0., far = 0., one = 0., seeds = 0.;
  int                   below = 0;
  constexpr int         n     = 100;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      {
        const dealii::Point<2> x(4. * i * length, 4. * j * length);
        const double           g = field(x);
        sum += g;
        square += g * g;
        one += g * field(x + dealii::Point<2>(0.6 * length, 0.8 * length));
        far += g * field(x + dealii::Point<2>(2. * length, 0.));
        seeds += g * other(x);
        below += weibull_of_normal(8., g) < std::pow(std::log(2.), 1. / 8.);
      }
  constexpr double count = n * n;
  BOOST_TEST(std::abs(sum / count) < 0.04);
  BOOST_TEST(std::abs(square / count - 1.) < 0.05);
  BOOST_TEST(std::abs(one / count - std::exp(-0.5)) < 0.05);
  BOOST_TEST(std::abs(far / count - std::exp(-2.)) < 0.05);
  BOOST_TEST(std::abs(seeds / count) < 0.04);
  BOOST_TEST(std::abs(below / count - 0.5) < 0.02);
}


BOOST_AUTO_TEST_CASE(explicit_flaws_leave_no_particle_without_one)
{
  constexpr unsigned int n     = 20000;
  const ExplicitFlaws    flaws = explicit_flaws(8., 1, n);
  unsigned int           below = 0;
  for (unsigned int i = 0; i < n; ++i)
    {
      BOOST_REQUIRE(flaws.count(i) >= 1);
      for (unsigned int k = flaws.first[i] + 1; k < flaws.first[i + 1]; ++k)
        BOOST_REQUIRE(flaws.threshold[k - 1] <= flaws.threshold[k]);
      const double weakest = flaws.threshold[flaws.first[i]];
      BOOST_REQUIRE(flaws.activated(i, weakest) == 0);
      BOOST_REQUIRE(flaws.activated(i, 1.0001 * weakest) >= 1);
      below += weakest < 1.;
    }
  // The weakest is Weibull distributed, about n ln n flaws are needed.
  BOOST_TEST(below / double(n) == 1. - std::exp(-1.), tolerance(0.03));
  BOOST_TEST(flaws.threshold.size() > 8 * n);
  BOOST_TEST(flaws.threshold.size() < 16 * n);
}


BOOST_AUTO_TEST_CASE(activated_flaws_set_the_pace_and_the_bound)
{
  DamageParameters p;
  p.flaws  = "Benz-Asphaug";
  p.growth = "Grady-Kipp";
  const DamageLaw law(p, material, strength, {1e-10, 1e-4});
  const double    dt = 1e-3 / law.flaw_speed;
  BOOST_TEST(explicit_flaw_damage(law, 0., 3, 4, dt) == 27e-9, tolerance(1e-9));
  BOOST_TEST(explicit_flaw_damage(law, 0.7, 3, 4, 1e4 * dt) == 0.75);
  BOOST_TEST(explicit_flaw_damage(law, 0.7, 0, 4, 1e4 * dt) == 0.7);
}

BOOST_AUTO_TEST_SUITE_END()
