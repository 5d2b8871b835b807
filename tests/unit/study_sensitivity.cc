// Studies: one entry at a time.
#include <morsel/core/errors.h>
#include <morsel/study/results.h>
#include <morsel/study/sensitivity.h>

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
  /// A study with two seeds and what stands in the sections.
  Morsel::Study::Study
  study_with(const std::string &sections)
  {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("morsel_sensitivity" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "base.prm")
        << "set Method = XFEM\nsubsection Material\n  set Young's modulus = "
           "2e9\nend\n";
    std::ofstream(folder / "study.prm") << R"(
subsection Study
  set Base scene = base.prm
end
subsection Axis seed
  set Kind    = seeds
  set Seed    = 5
  set Count   = 2
  set Entries = XFEM/Cells along x
end
subsection Quantity y
  set Truth = none
end
)" + sections;
    return read_study((folder / "study.prm").string());
  }


  const std::string two_entries = R"(
subsection Sensitivity small
  set Entries   = XFEM/Degree
  set Low       = 1
  set High      = 3
  set Numerical = true
end
subsection Sensitivity large
  set Entries  = Material/Young's modulus = {value}
  set Relative = true
  set Low      = 0.5
  set High     = 2
end
)";
} // namespace

BOOST_AUTO_TEST_SUITE(study_sensitivity)

BOOST_AUTO_TEST_CASE(each_run_is_varied_by_itself)
{
  const auto study = study_with(two_entries);
  const auto runs  = plan_runs(study);
  // Two seeds, and for each two values of two entries.
  BOOST_REQUIRE(runs.size() == 10u);
  for (unsigned int r = 0; r < 2; ++r)
    BOOST_TEST(runs[r].sensitivity.empty());
  BOOST_TEST(runs[2].sensitivity == "small");
  BOOST_TEST(runs[2].overrides.back() == "XFEM/Degree=1");
  BOOST_TEST(runs[2].overrides.front() == runs[0].overrides.front());
  BOOST_TEST(runs[7].overrides.back() == "Material/Young's modulus=4000000000");
  BOOST_TEST(runs[7].side == "high");
  BOOST_TEST(runs[7].varied == 4e9);
}


BOOST_AUTO_TEST_CASE(changes_are_of_pairs_and_come_by_size)
{
  const auto          study = study_with(two_entries);
  const auto          runs  = plan_runs(study);
  std::vector<Record> records(runs.size());
  for (unsigned int r = 0; r < runs.size(); ++r)
    {
      // Seeds scatter by far more than the entries do.
      const double seed = runs[r].numbers.at("seed") == 5. ? 100. : 300.;
      double       y    = seed;
      if (runs[r].sensitivity == "small")
        y += runs[r].side == "low" ? -1. : (seed == 100. ? 9. : 11.);
      if (runs[r].sensitivity == "large" && runs[r].side == "high")
        y *= 1.5;
      records[r].state              = Record::State::finished;
      records[r].results["y"].value = y;
    }
  const auto rows    = evaluate_runs(study, runs, records);
  const auto changes = sensitivity_changes(study, rows);
  BOOST_REQUIRE(changes.size() == 2u);
  BOOST_TEST(changes[0]["sensitivity"] == "large");
  BOOST_TEST(changes[0]["high"]["change"].get<double>() == 0.5,
             tt::tolerance(1e-12));
  BOOST_TEST(changes[0]["low"]["change"].get<double>() == 0.);
  BOOST_TEST(!changes[0]["beyond_bound"].get<bool>());
  const auto &high = changes[1]["high"];
  BOOST_TEST(high["change"].get<double>() == 0.05, tt::tolerance(1e-12));
  // Differences 9 and 11 over the mean of the base, 200.
  BOOST_TEST(high["standard_error"].get<double>() == 0.005,
             tt::tolerance(1e-12));
  BOOST_TEST(high["count"] == 2);
  BOOST_TEST(changes[1]["beyond_bound"].get<bool>());

  // Variations take no part in what the study shows otherwise.
  const auto json = study_json(study, rows);
  BOOST_TEST(json["runs"].size() == 10u);
  BOOST_TEST(json["statistics"].size() == 1u);
  BOOST_TEST(json["statistics"][0]["value"]["count"] == 2);
  BOOST_TEST(json["runs"][0]["variation"].is_null());
  BOOST_TEST(json["runs"][2]["variation"]["value"] == 1.);
  BOOST_TEST(study_csv(study, rows).find("small = 1") != std::string::npos);
}


BOOST_AUTO_TEST_CASE(a_series_may_stand_in_entries)
{
  const auto study = study_with(R"(
subsection Series XFEM
  set Entries = {series}/Degree = 2
end
subsection Series other
  set Title = another
end
subsection Sensitivity tip
  set Entries = {series}/Tip degree
  set Series  = XFEM
  set Low     = 1
  set High    = 2
end
)");
  const auto runs  = plan_runs(study);
  BOOST_REQUIRE(runs.size() == 8u);
  BOOST_TEST(runs[0].overrides.front() == "XFEM/Degree=2");
  BOOST_TEST(runs[4].overrides.back() == "XFEM/Tip degree=1");
}


BOOST_AUTO_TEST_CASE(mistakes_are_told)
{
  const auto says = [](const char *part) {
    return [part](const InputError &error) {
      return std::string(error.what()).find(part) != std::string::npos;
    };
  };
  const auto section = [](const std::string &text) {
    return "subsection Sensitivity a\n" + text + "\nend\n";
  };
  BOOST_CHECK_EXCEPTION(study_with(section("set High = 2")),
                        InputError,
                        says("'Sensitivity a/Entries' is missing"));
  BOOST_CHECK_EXCEPTION(study_with(section("set Entries = XFEM/Degree")),
                        InputError,
                        says("give two different values"));
  const auto study = study_with(section(
      "set Entries = Title = {value}\n set High = 2\n set Relative = true"));
  BOOST_CHECK_EXCEPTION(plan_runs(study),
                        InputError,
                        says("'Title' is no number in the base scene"));
}

BOOST_AUTO_TEST_SUITE_END()
