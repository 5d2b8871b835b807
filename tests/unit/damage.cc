// Proves: the damage drivers reach one at the prescribed strengths, softening
// is linear and monotone, growth follows Grady and Kipp's closed form, and the
// flaw thresholds and the bundle rule are what theory says.
#include <morsel/materials/flaws.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace Morsel::Materials;
using boost::test_tools::tolerance;

namespace
{
  const Elasticity material(23.9e6, 0.3, 1088.);
  constexpr double strength = 101.2e3;

  DamageParameters
  parameters_with(const std::string &driver)
  {
    DamageParameters p;
    p.enabled = true;
    p.driver  = driver;
    return p;
  }


  DamageLaw
  law_with(const std::string &driver, const double ratio = 10.)
  {
    DamageParameters p = parameters_with(driver);
    p.strength_ratio   = ratio;
    return {p, material, strength, {1e-10, 1e-4}};
  }


  /// Uniaxial stress in plane strain, at an angle to the axes.
  PlaneStrainStress
  uniaxial(const double sigma, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return {sigma * c * c,
            sigma * s * s,
            sigma * s * c,
            material.poissons_ratio * sigma};
  }
} // namespace


BOOST_AUTO_TEST_SUITE(damage)

BOOST_AUTO_TEST_CASE(von_mises_driver_is_one_at_both_strengths)
{
  for (const double ratio : {2., 5., 10., 15.})
    {
      const DamageLaw law = law_with("modified von Mises", ratio);
      for (const double angle : {0., 0.4, 1.5708})
        for (const bool cut_off : {true, false})
          {
            BOOST_TEST(
                driver_value(
                    law, material, uniaxial(-strength, angle), cut_off) == 1.,
                tolerance(1e-12));
            BOOST_TEST(driver_value(law,
                                    material,
                                    uniaxial(strength / ratio, angle),
                                    cut_off) == 1.,
                       tolerance(1e-12));
          }
    }
}


BOOST_AUTO_TEST_CASE(extension_strain_driver_is_one_in_compression)
{
  const DamageLaw law = law_with("extension strain");
  BOOST_TEST(driver_value(law, material, uniaxial(-strength, 0.3), true) == 1.,
             tolerance(1e-12));
  // It ties the strengths: f_c/f_t = (1 - nu)/nu in plane strain.
  const double tied = 0.3 / 0.7 * strength;
  BOOST_TEST(driver_value(law, material, uniaxial(tied, 0.3), true) == 1.,
             tolerance(1e-12));
}


BOOST_AUTO_TEST_CASE(tensile_stress_driver_sees_tension_alone)
{
  const DamageLaw law = law_with("tensile stress");
  BOOST_TEST(driver_value(law, material, uniaxial(0.1 * strength, 0.3), true) ==
                 1.,
             tolerance(1e-12));
  BOOST_TEST(driver_value(law, material, uniaxial(-strength, 0.3), true) <
             1e-12);
}


BOOST_AUTO_TEST_CASE(drivers_are_homogeneous_and_convex)
{
  // What makes the strongest driver a bound for every averaged stress.
  std::mt19937                     generator(2);
  std::normal_distribution<double> normal(0., strength);
  const auto                       random_stress = [&] {
    return PlaneStrainStress{normal(generator),
                             normal(generator),
                             normal(generator),
                             normal(generator)};
  };
  for (const char *name :
       {"modified von Mises", "extension strain", "tensile stress"})
    {
      const DamageLaw law = law_with(name);
      const auto      s   = [&](const PlaneStrainStress &t) {
        return driver_value(law, material, t, true);
      };
      for (int k = 0; k < 2000; ++k)
        {
          const auto a = random_stress(), b = random_stress();
          const auto middle = PlaneStrainStress{0.5 * (a.xx + b.xx),
                                                0.5 * (a.yy + b.yy),
                                                0.5 * (a.xy + b.xy),
                                                0.5 * (a.zz + b.zz)};
          BOOST_REQUIRE(s(middle) <= 0.5 * (s(a) + s(b)) + 1e-10);
          BOOST_REQUIRE(
              std::abs(s({3. * a.xx, 3. * a.yy, 3. * a.xy, 3. * a.zz}) -
                       3. * s(a)) < 1e-10 * (1. + s(a)));
        }
    }
}


BOOST_AUTO_TEST_CASE(softening_is_linear_and_monotone)
{
  const double r = 1.3, range = 10.;
  BOOST_TEST(linear_softening_damage(r, r, range) == 0.);
  BOOST_TEST(linear_softening_damage(range * r, r, range) == 1.);
  double last = 0.;
  for (int k = 1; k <= 1000; ++k)
    {
      const double s = r * (1. + (range - 1.) * k / 1000.);
      const double D = linear_softening_damage(s, r, range);
      BOOST_REQUIRE(D >= last);
      BOOST_REQUIRE(D <= 1.);
      BOOST_REQUIRE(std::abs((1. - D) * s - r * (1. - k / 1000.)) < 1e-12);
      last = D;
    }
}


BOOST_AUTO_TEST_CASE(softening_modes_take_away_what_they_say)
{
  const Tensor2 F{1.004, 0.001, 0.002, 0.99};
  const auto    r = neo_hookean(material, F);
  BOOST_REQUIRE(r.mean < 0.);
  const auto s = soften(Softening::deviator, r, 1.);
  BOOST_TEST(std::abs(s.xx - r.mean) + std::abs(s.yy - r.mean) +
                 std::abs(s.xy) + std::abs(s.zz - r.mean) <
             1e-10 * std::abs(r.mean));
  const auto t = soften(Softening::tensile_principal, r, 1.);
  BOOST_TEST(largest_principal(t.xx, t.yy, t.xy) < 1e-10 * std::abs(r.mean));
  const auto u = soften(Softening::tensile_principal, r, 0.);
  BOOST_TEST(u.xy == r.deviator.xy, tolerance(1e-12));
  BOOST_TEST(u.xx == r.deviator.xx + r.mean, tolerance(1e-12));

  // Released energy is never negative.
  double last = 1e300;
  for (const double D : {0., 0.2, 0.5, 0.9, 1.})
    {
      const double e = stored_energy(Softening::deviator, material, r, D);
      BOOST_TEST(e < last);
      BOOST_TEST(e > 0.);
      last = e;
    }
}


BOOST_AUTO_TEST_CASE(bundle_peak_tends_to_the_brittle_closed_form)
{
  for (const double m : {4., 8., 16.})
    {
      const double brittle = std::pow(m * std::exp(1.), -1. / m);
      const double b       = bundle_peak(m, 1.001);
      BOOST_TEST_MESSAGE("bundle peak, m = " << m << ": " << b << ", brittle "
                                             << brittle);
      BOOST_TEST(b == brittle, tolerance(2e-3));
    }
  BOOST_TEST(bundle_peak(8., 1.001) == 0.681, tolerance(2e-3));
  BOOST_TEST(bundle_peak(8., 10.) == 0.918, tolerance(1e-3));
  BOOST_TEST(bundle_peak(8., 1.0001) < bundle_peak(8., 2.));
  BOOST_TEST(bundle_peak(8., 2.) < bundle_peak(8., 10.));
}


BOOST_AUTO_TEST_CASE(threshold_rule)
{
  // r_i = c w_i / b; without scatter there is nothing to make good for.
  DamageParameters p = parameters_with("modified von Mises");
  p.threshold_factor = 1.1;
  BOOST_TEST(DamageLaw(p, material, strength, {1e-10, 1e-4}).threshold_scale ==
                 1.1 / std::tgamma(1.125),
             tolerance(1e-12));
  p.growth = "linear softening";
  BOOST_TEST(DamageLaw(p, material, strength, {1e-10, 1e-4}).threshold_scale ==
                 1.1 / bundle_peak(8., 10.),
             tolerance(1e-12));
  p.flaws = "uniform";
  BOOST_TEST(DamageLaw(p, material, strength, {1e-10, 1e-4}).threshold_scale ==
                 1.1,
             tolerance(1e-12));
}


BOOST_AUTO_TEST_CASE(thresholds_are_weibull)
{
  const double       m = 8.;
  const unsigned int n = 200000;
  double sum = 0., squares = 0., others = 0., product = 0., between_seeds = 0.;
  double distance = 0., last = 0.;
  std::vector<double> all(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      const double w = weibull_threshold(m, 1, i);
      all[i]         = w;
      sum += w;
      squares += w * w;
      product += w * last;
      const double other = weibull_threshold(m, 2, i);
      others += other;
      between_seeds += w * other;
      last = w;
    }
  const double mean     = std::tgamma(1. + 1. / m);
  const double variance = std::tgamma(1. + 2. / m) - mean * mean;
  const double found    = squares / n - sum / n * (sum / n);
  BOOST_TEST(sum / n == mean, tolerance(1e-3)); // 3 sigma: 1e-3
  BOOST_TEST(found == variance, tolerance(2e-2));
  // Neighbours and seeds have nothing to do with each other.
  BOOST_TEST(std::abs(product / n - sum / n * (sum / n)) < 0.01 * variance);
  BOOST_TEST(std::abs(between_seeds / n - sum / n * (others / n)) <
             0.01 * variance);

  // The whole distribution: Kolmogorov-Smirnov at the 0.1 % level.
  std::sort(all.begin(), all.end());
  for (unsigned int i = 0; i < n; ++i)
    {
      const double F = 1. - std::exp(-std::pow(all[i], m));
      distance = std::max({distance, F - double(i) / n, double(i + 1) / n - F});
    }
  BOOST_TEST_MESSAGE("Weibull thresholds: mean "
                     << sum / n << " (" << mean << "), variance " << found
                     << " (" << variance << "), KS distance " << distance);
  BOOST_TEST(distance < 1.95 / std::sqrt(n));
}


BOOST_AUTO_TEST_CASE(thresholds_depend_on_seed_and_index_alone)
{
  double             forwards[100];
  const unsigned int n = 100;
  for (unsigned int i = 0; i < n; ++i)
    forwards[i] = weibull_threshold(8., 7, i);
  for (unsigned int i = n; i-- > 0;)
    BOOST_TEST(weibull_threshold(8., 7, i) == forwards[i]);
  unsigned int same = 0;
  for (unsigned int i = 0; i < n; ++i)
    same += weibull_threshold(8., 8, i) == forwards[i];
  BOOST_TEST(same == 0u);
  // Seeds s and indices shifted alike must not give the same field.
  for (unsigned int i = 1; i < n; ++i)
    BOOST_TEST(weibull_threshold(8., 8, i - 1) != forwards[i]);
}


BOOST_AUTO_TEST_CASE(explicit_flaws_are_handed_out_until_all_have_one)
{
  const unsigned int n     = 2000;
  const double       m     = 8.;
  const auto         flaws = explicit_flaws(m, 3, n);
  // Drawn at random, n ln n + 0.577 n of them do (coupon collector's problem),
  // with a standard deviation of 1.28 n.
  const double expected = n * (std::log(1. * n) + 0.5772);
  BOOST_TEST(std::abs(flaws.threshold.size() - expected) < 4. * 1.28 * n);
  unsigned int last = 0;
  for (unsigned int i = 0; i < n; ++i)
    {
      BOOST_REQUIRE(flaws.count(i) >= 1u);
      last += flaws.count(i) == 1 &&
              flaws.threshold[flaws.first[i]] ==
                  std::pow(1. * flaws.threshold.size() / n, 1. / m);
      BOOST_TEST(std::is_sorted(flaws.threshold.begin() + flaws.first[i],
                                flaws.threshold.begin() + flaws.first[i + 1]));
      BOOST_TEST(flaws.activated(i, 0.) == 0u);
      BOOST_TEST(flaws.activated(i, 1e3) == flaws.count(i));
    }
  // The last one went to a particle that had none.
  BOOST_TEST(last == 1u);
  // n s^m thresholds lie below s, as Weibull's law has it.
  for (const double s : {0.7, 0.9, 1.})
    {
      unsigned int below = 0;
      for (unsigned int i = 0; i < n; ++i)
        below += flaws.activated(i, s);
      BOOST_TEST(std::abs(below - n * std::pow(s, m)) <= 1.);
    }
}


BOOST_AUTO_TEST_CASE(grady_kipp_follows_its_closed_form)
{
  DamageParameters p = parameters_with("tensile stress");
  p.growth           = "Grady-Kipp";
  const double    m = 8., volume = 1e-10;
  const DamageLaw law(p, material, strength, {volume, 1e-4});

  // alpha of T3-54 for k eps^m = (s/r0)^m / V, crack speed 0.4 c.
  const double alpha = 8. * std::acos(-1.) *
                       std::pow(0.4 * material.wave_speed, 3) /
                       ((m + 1.) * (m + 2.) * (m + 3.) * volume);
  double logarithms[2], peaks[2];
  for (const int k : {0, 1})
    {
      const double rate = k == 0 ? 200. : 2000.; // of s/r0 [1/s]
      // sigma_M with E = 1, from d/dt [(1 - D) t] = 0 at D = 1/(m + 4).
      const double t_peak =
          std::pow(1. / ((m + 4.) * alpha * std::pow(rate, m)), 1. / (m + 3.));
      const double dt = t_peak / 20000.;
      double       D = 0., peak = 0., at_peak = 0.;
      for (int n = 0; D < 1.; ++n)
        {
          // The middle of the step: second order.
          const double s = rate * (n + 0.5) * dt * law.threshold_scale;
          D              = grady_kipp_damage(law, D, s, 0., dt);
          const double t = (n + 1.) * dt;
          BOOST_REQUIRE(std::abs(D - std::min(1.,
                                              alpha * std::pow(rate, m) *
                                                  std::pow(t, m + 3.))) < 1e-4);
          if ((1. - D) * rate * t > peak)
            {
              peak    = (1. - D) * rate * t;
              at_peak = D;
            }
        }
      BOOST_TEST(at_peak == 1. / (m + 4.), tolerance(1e-2));
      BOOST_TEST(peak == (m + 3.) * std::pow(m + 4., -(m + 4.) / (m + 3.)) *
                             std::pow(alpha, -1. / (m + 3.)) *
                             std::pow(rate, 3. / (m + 3.)),
                 tolerance(1e-4));
      logarithms[k] = std::log(rate);
      peaks[k]      = std::log(peak);
    }
  const double slope = (peaks[1] - peaks[0]) / (logarithms[1] - logarithms[0]);
  BOOST_TEST_MESSAGE("Grady-Kipp: log peak over log rate "
                     << slope << ", 3/(m+3) = " << 3. / (m + 3.));
  BOOST_TEST(slope == 3. / (m + 3.), tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(grady_kipp_waits_for_the_threshold_and_never_heals)
{
  DamageParameters p = parameters_with("tensile stress");
  p.growth           = "Grady-Kipp";
  const DamageLaw law(p, material, strength, {1e-10, 1e-4});
  BOOST_TEST(grady_kipp_damage(law, 0.2, 0.99, 1., 1e-6) == 0.2);
  BOOST_TEST(grady_kipp_damage(law, 0.2, 1.01, 1., 1e-6) > 0.2);
  BOOST_TEST(grady_kipp_damage(law, 0.999, 1e3, 1., 1.) == 1.);
}

BOOST_AUTO_TEST_SUITE_END()
