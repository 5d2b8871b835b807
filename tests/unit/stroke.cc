// The analysis of a stroke, fed with force curves whose answers are known.
#include <morsel/measure/stroke.h>

#include <boost/test/unit_test.hpp>

using namespace Morsel::Measure;

namespace
{
  /// Height 10 mm, area 100 mm^2, strength 100 kPa.
  StrokeSettings
  settings()
  {
    StrokeSettings s;
    s.loaded_area         = 1e-4;
    s.height              = 0.01;
    s.prescribed_strength = 1e5;
    s.minimum_peak        = 1e4;
    return s;
  }


  StrokeSample
  sample(const double strain, const double force)
  {
    StrokeSample s;
    s.time             = strain;
    s.closure          = 0.01 * strain;
    s.normal_force     = {1.1 * force, 0.9 * force};
    s.tangential_force = {0.1 * force, 0.2 * force};
    s.strain_energy    = force;
    s.kinetic_energy   = 0.02 * force;
    return s;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(strokes)


BOOST_AUTO_TEST_CASE(a_brittle_curve)
{
  Stroke stroke(settings());
  // Noise of the first touch, which falls to nothing, is no failure.
  stroke.add(sample(0., 0.05));
  stroke.add(sample(0.0005, 0.));
  BOOST_CHECK(!stroke.time_of_failure());
  // Modulus 5 MPa up to 102 kPa (10.2 N).
  for (double strain = 0.001; strain < 0.02041; strain += 0.0001)
    stroke.add(sample(strain, 500. * strain));
  BOOST_CHECK(!stroke.failed_completely());
  stroke.add(sample(0.022, 3.));
  BOOST_CHECK(!stroke.time_of_failure());
  stroke.add(sample(0.023, 1.));
  BOOST_REQUIRE(stroke.time_of_failure());
  BOOST_CHECK_CLOSE(*stroke.time_of_failure(), 0.023, 1e-8);
  BOOST_CHECK(!stroke.failed_completely());
  stroke.add(sample(0.0335, 1.5));

  BOOST_CHECK(stroke.failed_completely());
  BOOST_CHECK_CLOSE(stroke.compressive_strength(), 1.02e5, 1e-6);
  BOOST_CHECK_CLOSE(*stroke.compressive_strength_error(), 0.02, 1e-4);
  BOOST_CHECK_CLOSE(*stroke.stiffness(), 5e6, 1e-6);
  BOOST_CHECK_CLOSE(stroke.time_of_peak(), 0.0204, 1e-6);
  BOOST_CHECK_CLOSE(stroke.strain_at_peak(), 0.0204, 1e-6);
  BOOST_CHECK_CLOSE(stroke.peak_force(0), 11.22, 1e-6);
  BOOST_CHECK_CLOSE(stroke.peak_force(1), 9.18, 1e-6);
  BOOST_CHECK_CLOSE(stroke.peak_tangential_force(1), 2.04, 1e-6);
  BOOST_CHECK_CLOSE(*stroke.kinetic_over_strain_energy(), 0.02, 1e-6);
  BOOST_CHECK_CLOSE(*stroke.largest_kinetic_over_strain_energy(), 0.02, 1e-6);
  // Below half at 0.022. No step begins in the second half of what follows.
  BOOST_CHECK_CLOSE(*stroke.time_of_half_force(), 0.022, 1e-6);
  BOOST_CHECK_CLOSE(*stroke.strain_from_peak_to_half(), 0.0016, 1e-4);
  BOOST_CHECK_CLOSE(*stroke.brittleness(), 0.0204 / 0.022, 1e-4);
  BOOST_CHECK(!stroke.residual_strength());
  stroke.add(sample(0.034, 2.5));
  stroke.add(sample(0.036, 0.5));
  // From 0.029 on: 15 kPa to 25 kPa over 0.0005, to 5 kPa over 0.002.
  BOOST_CHECK_CLOSE(*stroke.residual_strength(), 1.6e4, 1e-4);
  BOOST_CHECK_CLOSE(stroke.nominal_stress(), 5e3, 1e-6);
  BOOST_CHECK_CLOSE(stroke.nominal_strain(), 0.036, 1e-6);
}


BOOST_AUTO_TEST_CASE(a_higher_peak_withdraws_a_failure)
{
  Stroke stroke(settings());
  stroke.add(sample(0.01, 5.));
  stroke.add(sample(0.012, 0.5));
  BOOST_CHECK(stroke.time_of_failure());
  stroke.add(sample(0.02, 9.));
  BOOST_CHECK(!stroke.time_of_failure());
  BOOST_CHECK(!stroke.time_of_half_force());
  BOOST_CHECK(!stroke.failed_completely());
}


BOOST_AUTO_TEST_CASE(nothing_happened)
{
  Stroke stroke(settings());
  BOOST_CHECK(!stroke.stiffness());
  BOOST_CHECK(!stroke.kinetic_over_strain_energy());
  BOOST_CHECK_EQUAL(stroke.compressive_strength(), 0.);
  stroke.add(sample(0., 0.));
  BOOST_CHECK(!stroke.failed_completely());
  BOOST_CHECK_EQUAL(stroke.peak_force(7), 0.);
}


BOOST_AUTO_TEST_SUITE_END()
