// Studies: straight lines, correlations, and what a publication states.
#include <morsel/core/errors.h>
#include <morsel/study/claims.h>
#include <morsel/study/regression.h>
#include <morsel/study/relations.h>

#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace Morsel;
using namespace Morsel::Study;
namespace tt = boost::test_tools;

namespace
{
  // F. J. Anscombe, Graphs in statistical analysis, 1973: the first set.
  const std::vector<double> anscombe_x = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> anscombe_y =
      {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};


  /// Three settings of two seeds each, y = 3 + 2 n on average.
  struct Fixture
  {
    Fixture()
    {
      const auto folder = std::filesystem::temp_directory_path() /
                          ("morsel_claims" + std::to_string(getpid()));
      std::filesystem::create_directories(folder);
      std::ofstream(folder / "base.prm") << "set Method = XFEM\n";
      std::ofstream(folder / "study.prm") << R"(
subsection Study
  set Base scene = base.prm
  set Resolution = n
end
subsection Axis n
  set Values  = 1, 2, 4
  set Entries = XFEM/Cells along x
end
subsection Axis seed
  set Kind    = seeds
  set Count   = 2
  set Entries = Seed
end
subsection Quantity size
  set Expression = n
end
subsection Quantity y
  set Truth = none
end
subsection Relation r
  set x = size
  set y = y
  set Expected correlation = 0.5
  set Expected points      = 28
end
subsection Claim finest
  set Value    = 10
  set Quantity = y
end
subsection Claim coarse
  set Value    = 10
  set Quantity = y
  set At       = n = 1
end
subsection Claim correlation
  set Value    = 0.84
  set Relation = r
end
subsection Figure f
  set x     = time [s]
  set y     = force [N]
  set Where = n = 2; seed = 2
end
)";
      study   = read_study((folder / "study.prm").string());
      planned = plan_runs(study);
      for (const PlannedRun &run : planned)
        {
          Record record;
          record.state             = Record::State::finished;
          const double seed_effect = run.numbers.at("seed") == 1. ? 0.5 : -0.5;
          record.results["y"].value =
              3. + 2. * run.numbers.at("n") + seed_effect;
          records.push_back(record);
        }
    }

    Morsel::Study::Study    study;
    std::vector<PlannedRun> planned;
    std::vector<Record>     records;
  };
} // namespace

BOOST_AUTO_TEST_SUITE(study_comparisons)

BOOST_AUTO_TEST_CASE(anscombes_line)
{
  const auto line = fit_line(anscombe_x, anscombe_y);
  BOOST_TEST(line->slope == 0.5000909, tt::tolerance(1e-6));
  BOOST_TEST(line->intercept == 3.0000909, tt::tolerance(1e-6));
  // Standard error 0.1179, and t = 2.26216 of nine degrees of freedom.
  BOOST_TEST(line->slope_interval->high - line->slope == 0.26671,
             tt::tolerance(1e-3));
  const auto correlation = correlate(anscombe_x, anscombe_y);
  BOOST_TEST(correlation->coefficient == 0.8164205, tt::tolerance(1e-6));
  BOOST_TEST(correlation->p_value == 0.00217, tt::tolerance(2e-3));
  // tanh(1.14602 -+ 1.95996 / sqrt(8))
  BOOST_TEST(correlation->interval->low == 0.42435, tt::tolerance(1e-3));
  BOOST_TEST(correlation->interval->high == 0.95069, tt::tolerance(1e-3));
}


BOOST_AUTO_TEST_CASE(what_has_no_line)
{
  BOOST_TEST(!fit_line({1., 1., 1.}, {1., 2., 3.}).has_value());
  BOOST_TEST(!fit_line({1.}, {1.}).has_value());
  BOOST_TEST(!correlate({1., 2.}, {1., 2.}).has_value());
  BOOST_TEST(!correlate({1., 2., 3.}, {5., 5., 5.}).has_value());
  // Tiny numbers in SI units vary as well as large ones.
  BOOST_TEST(fit_line({1e-12, 2e-12}, {0., 1.})->slope == 1e12,
             tt::tolerance(1e-12));
  const auto exact = correlate({1., 2., 3., 4.}, {2., 4., 6., 8.});
  BOOST_TEST(exact->coefficient == 1., tt::tolerance(1e-12));
  BOOST_TEST(!exact->interval.has_value());
}


BOOST_AUTO_TEST_CASE(slopes_and_correlations_compared)
{
  const auto line = fit_line(anscombe_x, anscombe_y);
  BOOST_TEST(*p_of_equal_slopes(*line, *line) == 1., tt::tolerance(1e-12));
  std::vector<double> steeper = anscombe_y;
  for (std::size_t i = 0; i < steeper.size(); ++i)
    steeper[i] += 0.5 * anscombe_x[i];
  // The residuals are the same: t = 0.5 / (sqrt(2) 0.11790) with 18 degrees.
  BOOST_TEST(*p_of_equal_slopes(*line, *fit_line(anscombe_x, steeper)) ==
                 0.00772,
             tt::tolerance(0.01));
  // z = (atanh 0.8 - atanh 0.5) / sqrt(1/25 + 1/10) = 1.4681
  BOOST_TEST(*p_of_equal_correlations(0.8, 28, 0.5, 13) == 0.1421,
             tt::tolerance(2e-3));
  BOOST_TEST(!p_of_equal_correlations(0.8, 28, 0.5, 0).has_value());
}


BOOST_FIXTURE_TEST_CASE(draws_are_averaged_in_relations, Fixture)
{
  const auto  rows      = evaluate_runs(study, planned, records);
  const auto  relations = relations_json(study, rows);
  const auto &group     = relations[0]["groups"][0];
  BOOST_TEST(group["points"].size() == 3);
  BOOST_TEST(group["points"][2]["y"].get<double>() == 11.,
             tt::tolerance(1e-12));
  BOOST_TEST(group["points"][2]["count"].get<int>() == 2);
  BOOST_TEST(group["points"][2]["label"].get<std::string>() == "n = 4");
  BOOST_TEST(group["slope"].get<double>() == 2., tt::tolerance(1e-12));
  BOOST_TEST(group["correlation"].get<double>() == 1., tt::tolerance(1e-12));
  BOOST_TEST(group["correlation_low"].is_null());
}


BOOST_FIXTURE_TEST_CASE(claims_beside_what_was_found, Fixture)
{
  auto       rows   = evaluate_runs(study, planned, records);
  const auto claims = claims_json(study, rows);
  BOOST_TEST(claims[0]["ours"].get<double>() == 11., tt::tolerance(1e-12));
  BOOST_TEST(claims[0]["difference"].get<double>() == 0.1,
             tt::tolerance(1e-12));
  BOOST_TEST(claims[0]["ours_deviation"].get<double>() == std::sqrt(0.5),
             tt::tolerance(1e-12));
  BOOST_TEST(claims[1]["ours"].get<double>() == 5., tt::tolerance(1e-12));
  BOOST_TEST(claims[2]["ours"].get<double>() == 1., tt::tolerance(1e-12));
  const auto figures = figures_json(study, rows);
  BOOST_TEST(figures[0]["runs"].size() == 1);
  BOOST_TEST(figures[0]["runs"][0].get<int>() == 3);

  for (Record &record : records)
    record.state = Record::State::failed;
  rows               = evaluate_runs(study, planned, records);
  const auto nothing = claims_json(study, rows);
  BOOST_TEST(nothing[0]["ours"].is_null());
  BOOST_TEST(nothing[0]["note"].get<std::string>() ==
             "no such run has finished");
  BOOST_TEST(nothing[2]["ours"].is_null());
}

BOOST_AUTO_TEST_SUITE_END()
