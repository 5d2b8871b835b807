// Studies: what a study's file means, what its runs say together.
#include <morsel/core/errors.h>
#include <morsel/study/analysis.h>
#include <morsel/study/evaluation.h>
#include <morsel/study/findings.h>

#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace Morsel;
using namespace Morsel::Study;

namespace
{
  /// A study of the given text, beside a base scene of no content.
  Morsel::Study::Study
  study_of(const std::string &text)
  {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("morsel_study" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "base.prm") << "set Method = XFEM\n";
    std::ofstream(folder / "study.prm") << text;
    return read_study((folder / "study.prm").string());
  }


  const std::string beginning = "subsection Study\n set Base scene = base.prm\n"
                                " set Resolution = n\nend\n"
                                "subsection Quantity K\nset Truth = formula\n"
                                "set Truth formula = 2*n\nend\n";


  /// A record of a finished run with these results.
  Record
  finished(const std::map<std::string, double> &values)
  {
    Record record;
    record.state = Record::State::finished;
    for (const auto &[name, value] : values)
      record.results[name].value = value;
    record.times = {values.at("wall_time_loop")};
    return record;
  }


  /// Whether the error's sentence holds the text.
  auto
  says(const std::string &text)
  {
    return [text](const InputError &error) {
      const bool found =
          std::string(error.what()).find(text) != std::string::npos;
      if (!found)
        BOOST_TEST_MESSAGE(error.what());
      return found;
    };
  }
} // namespace


BOOST_AUTO_TEST_SUITE(study)

BOOST_AUTO_TEST_CASE(rate_of_an_exact_power_law)
{
  const std::vector<double> n = {5., 10., 20., 40.};
  std::vector<double>       error;
  for (const double x : n)
    error.push_back(3. * std::pow(x, -2.5));
  const auto fit = fit_rate(n, error);
  BOOST_REQUIRE(fit && fit->low && fit->high);
  BOOST_CHECK_CLOSE(fit->rate, 2.5, 1e-8);
  BOOST_CHECK_CLOSE(fit->constant, 3., 1e-8);
  BOOST_CHECK_SMALL(*fit->high - *fit->low, 1e-6);
  BOOST_CHECK_EQUAL(fit->n_points, 4u);
}


BOOST_AUTO_TEST_CASE(confidence_of_a_rate)
{
  // log(error) = 0, -1, -1, -3 at log(n) = 0, 1, 2, 3: by hand the slope is
  // -0.9, the sum of the squared residuals 0.7, and t(0.975, 2) = 4.302653.
  std::vector<double> n, error;
  for (const double x : {0., 1., 2., 3.})
    n.push_back(std::exp(x));
  for (const double y : {0., -1., -1., -3.})
    error.push_back(std::exp(y));
  const auto fit = fit_rate(n, error);
  BOOST_REQUIRE(fit && fit->low && fit->high);
  BOOST_CHECK_CLOSE(fit->rate, 0.9, 1e-8);
  const double half = 4.302653 * std::sqrt(0.7 / 2. / 5.);
  BOOST_CHECK_CLOSE(*fit->high - fit->rate, half, 1e-4);
  BOOST_CHECK_CLOSE(fit->rate - *fit->low, half, 1e-4);

  // Two points have a rate without confidence, one has none; an error of 0
  // has no logarithm.
  BOOST_CHECK(!fit_rate({1., 2.}, {1., 0.5})->low);
  BOOST_CHECK(!fit_rate({1., 2.}, {1., 0.}));
  BOOST_CHECK(!fit_rate({2., 2., 2.}, {1., 2., 3.}));
}


BOOST_AUTO_TEST_CASE(front_of_what_nothing_beats)
{
  const std::vector<double>       cost  = {3., 1., 2., 4., 2., 1.};
  const std::vector<double>       error = {0.2, 1., 0.5, 0.2, 0.4, 2.};
  const std::vector<unsigned int> front = pareto_front(cost, error);
  const std::vector<unsigned int> right = {1, 4, 0};
  BOOST_CHECK_EQUAL_COLLECTIONS(
      front.begin(), front.end(), right.begin(), right.end());
}


BOOST_AUTO_TEST_CASE(cost_of_an_error)
{
  using Kind                       = CostToReach::Kind;
  const std::vector<double> cost   = {1., 10., 100.};
  const std::vector<double> error  = {1e-1, 1e-2, 1e-3};
  const CostToReach         middle = cost_to_reach(cost, error, 1e-2 / 3.);
  BOOST_CHECK(middle.kind == Kind::interpolated);
  BOOST_CHECK_CLOSE(middle.cost, 30., 1e-8);
  BOOST_CHECK(cost_to_reach(cost, error, 0.2).kind == Kind::at_most);
  BOOST_CHECK_EQUAL(cost_to_reach(cost, error, 0.2).cost, 1.);
  BOOST_CHECK(cost_to_reach(cost, error, 1e-4).kind == Kind::not_reached);

  // The second run was lucky; the error stays below 1e-2 from the third on.
  const CostToReach late =
      cost_to_reach({1., 2., 10., 100.}, {1e-1, 1e-4, 1e-1, 1e-3}, 1e-2);
  BOOST_CHECK_CLOSE(late.cost, 10. * std::sqrt(10.), 1e-8);
}


BOOST_AUTO_TEST_CASE(figures_of_a_sample)
{
  const Statistics s = statistics_of({4., 1., 2., 5.});
  BOOST_CHECK_CLOSE(s.mean, 3., 1e-10);
  BOOST_CHECK_CLOSE(s.sd, std::sqrt(10. / 3.), 1e-10);
  BOOST_CHECK_CLOSE(s.median, 3., 1e-10);
  BOOST_CHECK_EQUAL(s.low, 1.);
  BOOST_CHECK_EQUAL(s.high, 5.);
}


BOOST_AUTO_TEST_CASE(formulas)
{
  BOOST_CHECK_CLOSE(
      evaluate("K_1/sqrt(pi*a) + 1e-3", {{"K_1", 2.}, {"a", 0.01}}),
      2. / std::sqrt(0.01 * 3.14159265358979) + 1e-3,
      1e-8);
  BOOST_CHECK_EQUAL(
      fill_in("0, 0.5 > {0.01*a}, {b}", {{"a", 30.}}, {{"b", "x"}}),
      "0, 0.5 > 0.3, x");
  BOOST_CHECK_EXCEPTION(evaluate("2*lenght", {{"length", 1.}}),
                        InputError,
                        says("Did you mean 'length'?"));
  BOOST_CHECK_EXCEPTION(
      evaluate("2*+)", {}), InputError, says("is not understood"));
  BOOST_CHECK_EXCEPTION(
      fill_in("{1/a}", {{"a", 0.}}, {}), InputError, says("no finite number"));
}


BOOST_AUTO_TEST_CASE(values_of_axes)
{
  const auto study = study_of(
      beginning + "subsection Axis n\n set Kind = linear\n set From = 1\n set "
                  "To = 2\n set Count = 3\n set Entries = A/b\nend\n"
                  "subsection Axis l\n set Kind = logarithmic\n set From = "
                  "10\n set To = 1000\n set Count = 4\n set Whole numbers = "
                  "true\n set Entries = A/c\nend\n"
                  "subsection Axis s\n set Kind = seeds\n set Seed = 7\n set "
                  "Count = 2\n set Entries = Seed\nend\n"
                  "subsection Axis t\n set Kind = texts\n set Values = 0, 1; "
                  "0, 2\n set Entries = A/d\nend\n"
                  "subsection Axis r\n set Kind = random\n set To = 1\n set "
                  "Count = 1000\n set Entries = A/e\nend\n");
  const auto check = [&](const char *name, const std::vector<std::string> &v) {
    const auto values = values_of(study, *study.find_axis(name));
    BOOST_CHECK_EQUAL_COLLECTIONS(
        values.begin(), values.end(), v.begin(), v.end());
  };
  check("n", {"1", "1.5", "2"});
  check("l", {"10", "46", "215", "1000"});
  check("s", {"7", "8"});
  check("t", {"0, 1", "0, 2"});
  // Draws are the same in every call, and uniform.
  const auto draws = values_of(study, *study.find_axis("r"));
  check("r", draws);
  std::vector<double> numbers;
  for (const std::string &draw : draws)
    numbers.push_back(*number_in(draw));
  const Statistics s = statistics_of(numbers);
  BOOST_CHECK_SMALL(s.mean - 0.5, 0.03);
  BOOST_CHECK_SMALL(s.sd - std::sqrt(1. / 12.), 0.02);
}


BOOST_AUTO_TEST_CASE(product_and_partners)
{
  const auto study = study_of(
      beginning +
      "subsection Axis n\n set Values = 5, 7\n set Entries = X/n; Y/n\nend\n"
      "subsection Axis r\n set Values = 0.1, 0.2\n set Together with = n\n set "
      "Entries = X/radius = 0;; {2*r}\nend\n"
      "subsection Axis a\n set Values = 1, 2, 3\n set Entries = X/a\nend\n"
      "subsection Series one\n set Axes = n, a\n set Entries = X/p = 1, "
      "1\nend\n"
      "subsection Series two\n set Axes = n, r\n set Entries = X/p = 2\nend\n");
  const std::vector<PlannedRun> runs = plan_runs(study);
  BOOST_REQUIRE_EQUAL(runs.size(), 2u * 3u + 2u);
  const std::vector<std::string> first = {
      "X/p=1, 1", "X/n=5", "Y/n=5", "X/a=2"};
  BOOST_CHECK_EQUAL_COLLECTIONS(runs[1].overrides.begin(),
                                runs[1].overrides.end(),
                                first.begin(),
                                first.end());
  const std::vector<std::string> last = {
      "X/p=2", "X/n=7", "Y/n=7", "X/radius=0; 0.4"};
  BOOST_CHECK_EQUAL_COLLECTIONS(runs[7].overrides.begin(),
                                runs[7].overrides.end(),
                                last.begin(),
                                last.end());
  std::set<std::string> folders;
  for (const PlannedRun &run : runs)
    folders.insert(run.folder);
  BOOST_CHECK_EQUAL(folders.size(), runs.size());
}


BOOST_AUTO_TEST_CASE(partners_of_different_length)
{
  const auto study = study_of(
      beginning + "subsection Axis n\n set Values = 5, 7\n set Entries "
                  "= X/n\nend\nsubsection Axis r\n set Values = 1\n "
                  "set Together with = n\n set Entries = X/r\nend\n");
  BOOST_CHECK_EXCEPTION(
      plan_runs(study), InputError, says("the axis has 1 values"));
}


BOOST_AUTO_TEST_CASE(errors_rates_and_what_no_run_gives)
{
  const auto study = study_of(
      beginning + "subsection Axis n\n set Values = 10, 20, 40\n set Entries "
                  "= X/n\nend\n"
                  "subsection Quantity J\n set Expression = 2*L\n set Truth = "
                  "finest run\nend\n");
  const std::vector<PlannedRun> runs = plan_runs(study);
  std::vector<Record>           records;
  for (const double n : {10., 20., 40.})
    records.push_back(finished({{"K", 2. * n * (1. + 1. / (n * n))},
                                {"L", 1. + 1. / n},
                                {"wall_time_loop", n},
                                {"dof_count", n * n}}));
  check_formulas(study, runs);
  check_results(study, runs, records);
  const std::vector<Row> rows = evaluate_runs(study, runs, records);
  BOOST_CHECK_CLOSE(*rows[1].quantities[0].truth, 40., 1e-10);
  BOOST_CHECK_CLOSE(*rows[1].quantities[0].error, 1. / 400., 1e-8);
  BOOST_CHECK_CLOSE(*rows[0].quantities[1].truth, 2.05, 1e-10);
  BOOST_CHECK(!rows[2].quantities[1].error);
  BOOST_CHECK_EQUAL(*rows[2].unknowns, 1600.);

  const auto rates = fitted_rates(study, rows);
  BOOST_REQUIRE_EQUAL(rates.size(), 2u);
  BOOST_CHECK_CLOSE(rates[0]["rate"].get<double>(), 2., 1e-8);
  BOOST_CHECK_EQUAL(rates[1]["points"].get<unsigned int>(), 2u);

  for (Record &record : records)
    record.results.erase("L");
  BOOST_CHECK_EXCEPTION(check_results(study, runs, records),
                        InputError,
                        says("names 'L', which no run gives"));
}


BOOST_AUTO_TEST_CASE(failed_runs_have_no_values)
{
  const auto study = study_of(beginning + "subsection Axis n\n set Values = 1, "
                                          "2\n set Entries = X/n\nend\n");
  const auto runs  = plan_runs(study);
  std::vector<Record> records(2);
  records[0].state = Record::State::failed;
  records[1] = finished({{"K", 4.}, {"wall_time_loop", 1.}, {"dof_count", 2.}});
  const auto rows = evaluate_runs(study, runs, records);
  BOOST_CHECK(!rows[0].quantities[0].value && !rows[0].time);
  BOOST_CHECK_EQUAL(*rows[1].quantities[0].error, 0.);
  // An error of zero has no logarithm: there is no rate, and no fault.
  BOOST_CHECK(fitted_rates(study, rows).empty());
}

BOOST_AUTO_TEST_SUITE_END()
