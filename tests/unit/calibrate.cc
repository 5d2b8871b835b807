// Calibration: the search for parameters, and what a round of runs tells.
#include <morsel/calibrate/outcome.h>
#include <morsel/calibrate/rounds.h>
#include <morsel/calibrate/search.h>
#include <morsel/core/errors.h>

#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include <cmath>

using namespace Morsel;
using namespace Morsel::Calibrate;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_SUITE(calibrate)

BOOST_AUTO_TEST_CASE(proportional_strength_takes_one_step)
{
  Search search({1.16}, {{1.}});
  search.take({1.16 / 1.02});
  BOOST_TEST(search.parameters()[0] == 1.02, tt::tolerance(1e-5));
}


BOOST_AUTO_TEST_CASE(power_law_takes_two_steps)
{
  // f = (c / 1.3)^0.7
  const auto ratio = [](const double c) { return std::pow(c / 1.3, 0.7); };
  Search     search({1.}, {{1.}});
  search.take({ratio(search.parameters()[0])});
  BOOST_TEST(std::abs(ratio(search.parameters()[0]) - 1.) > 0.02);
  search.take({ratio(search.parameters()[0])});
  BOOST_TEST(search.parameters()[0] == 1.3, tt::tolerance(2e-5));
}


BOOST_AUTO_TEST_CASE(two_strengths_are_found_together)
{
  // Both deviate from the first order f_c ~ c, f_t ~ c/k.
  const auto ratios = [](const std::vector<double> &p) {
    const double c = p[0], k = p[1];
    return std::vector<double>{1.1 * std::pow(c, 0.9) * std::pow(k / 10., 0.05),
                               0.8 * std::pow(c, 1.1) * std::pow(10. / k, 0.8)};
  };
  Search       search({1., 10.}, {{1., 0.}, {1., -1.}});
  unsigned int rounds = 0;
  const auto   error  = [&] {
    const auto f = ratios(search.parameters());
    return std::max(std::abs(f[0] - 1.), std::abs(f[1] - 1.));
  };
  for (; error() > 0.005 && rounds < 10; ++rounds)
    search.take(ratios(search.parameters()));
  BOOST_TEST(error() < 0.005);
  BOOST_TEST(rounds <= 4u);
}


BOOST_AUTO_TEST_CASE(steps_are_bounded_and_digits_are_told)
{
  Search search({1.}, {{1.}});
  search.take({1e-6});
  BOOST_TEST(search.parameters()[0] == 2.);
  search.take({0.9 * 1.23456789});
  BOOST_TEST(std::abs(std::round(search.parameters()[0] * 1e5) / 1e5 -
                      search.parameters()[0]) < 1e-12);
}


BOOST_AUTO_TEST_CASE(a_step_that_did_not_help_says_nothing_of_the_slope)
{
  Search search({1.}, {{1.}});
  search.take({1.1});
  search.take({1.2});
  // As if the second were the first.
  BOOST_TEST(search.parameters()[0] == 0.90909 / 1.2, tt::tolerance(1e-4));
}


BOOST_AUTO_TEST_CASE(a_plateau_does_not_throw_the_search_far_off)
{
  Search search({1.}, {{1.}});
  search.take({1.1});
  search.take({1.099});
  // The secant asks for a factor of two, the first order for 1.1.
  BOOST_TEST(search.parameters()[0] == 0.90909 / (1.099 * 1.099),
             tt::tolerance(1e-4));
}


BOOST_AUTO_TEST_CASE(scatter_gives_the_standard_error)
{
  std::vector<Sample> samples(4);
  for (unsigned int k = 0; k < 4; ++k)
    samples[k].value = 100. + 2. * k; // mean 103, deviation sqrt(20/3)
  const Measurement m = measurement_of(samples, 100.);
  BOOST_TEST(m.mean == 103.);
  BOOST_TEST(m.error == 0.03, tt::tolerance(1e-12));
  BOOST_TEST(*m.deviation == std::sqrt(20. / 3.) / 103., tt::tolerance(1e-12));
  BOOST_TEST(*m.standard_error == *m.deviation / 2., tt::tolerance(1e-12));
  samples.resize(1);
  BOOST_TEST(!measurement_of(samples, 100.).standard_error);
}


BOOST_AUTO_TEST_CASE(a_scatter_beyond_the_tolerance_is_told)
{
  Problem problem;
  problem.body             = "food";
  problem.parameters.seeds = 2;
  problem.targets = {{"compressive strength", 100e3, "a.prm", "food", "", {}}};
  Round               round;
  std::vector<Sample> samples(2);
  samples[0].value       = 95e3;
  samples[1].value       = 105e3;
  round.threshold_factor = 1.5;
  round.targets          = {measurement_of(samples, 100e3)};
  Outcome outcome;
  outcome.rounds      = {round};
  outcome.converged   = true;
  const std::string s = conclusion(problem, outcome);
  BOOST_TEST(s.find("standard error of 5 %, more than the tolerance of 1 %") !=
             std::string::npos);
  BOOST_TEST(s.find("set Threshold factor = 1.5") != std::string::npos);
  BOOST_TEST(calibration_json(problem, outcome)["damage"]["threshold_factor"] ==
             1.5);
}


BOOST_AUTO_TEST_CASE(what_cannot_be_calibrated_is_told)
{
  CommandLine command_line;
  const auto  says = [](const char *part) {
    return [part](const InputError &error) {
      return std::string(error.what()).find(part) != std::string::npos;
    };
  };
  const std::string prm   = MORSEL_SOURCE_DIR "/prm/";
  const auto        fails = [&](const std::string              &file,
                         const std::vector<std::string> &overrides,
                         const char                     *part) {
    command_line.scene_file = prm + file;
    command_line.overrides  = overrides;
    BOOST_CHECK_EXCEPTION(read_problem(command_line), InputError, says(part));
  };
  fails("sph/tension_block.prm", {}, "Damage/Enabled' is false");
  fails("sph/tension_block.prm",
        {"Body block/Damage/Enabled=true",
         "Body block/Material/Compressive strength=1e5"},
        "has no plates");
  fails("fracture/m1_xfem.prm", {}, "is a cracked plate");
  fails("studies/fracture/m2_angle.prm", {}, "is a study");
  fails("food/peanut.prm",
        {"Calibration/Tensile strength=1e4"},
        "needs 'Calibration/Tension scene'");
  fails("food/peanut.prm",
        {"Calibration/Tension scene=almond.prm"},
        "but no 'Calibration/Tensile strength'");
  fails("food/peanut.prm",
        {"Calibration/Tensile strength=1e4",
         "Calibration/Tension scene=almonds.prm"},
        "Did you mean '");
}


BOOST_AUTO_TEST_CASE(the_tension_scene_gets_the_same_solid)
{
  CommandLine command_line;
  command_line.scene_file = MORSEL_SOURCE_DIR "/prm/food/peanut.prm";
  command_line.overrides  = {"Calibration/Tensile strength=1e4",
                             "Calibration/Tension scene=../rock/basalt.prm",
                             "Body food/Damage/Weibull modulus=5",
                             "Body food/Damage/Fracture energy=40",
                             "Calibration/Particles across=21"};
  const Problem problem   = read_problem(command_line);
  BOOST_TEST(problem.particles_across == 21u);
  BOOST_REQUIRE(problem.targets.size() == 2u);
  BOOST_TEST(problem.targets[1].body == "rock");
  const auto &o   = problem.targets[1].overrides;
  const auto  has = [&](const char *text) {
    return std::count(o.begin(), o.end(), text) == 1;
  };
  BOOST_TEST(has("Body rock/Damage/Weibull modulus=5"));
  BOOST_TEST(has("Body rock/Material/Density=1088"));
}

BOOST_AUTO_TEST_SUITE_END()
