#include <morsel/core/errors.h>
#include <morsel/output/history.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <limits>

using namespace Morsel;


BOOST_AUTO_TEST_CASE(history_keeps_every_complete_row)
{
  const auto folder =
      std::filesystem::temp_directory_path() / "morsel_unit_history";
  std::filesystem::create_directories(folder);
  const auto      file = (folder / "history.csv").string();
  Output::History history(file, {"time [s]", "force [N]"});
  history.add_row({0., 1.25e-7});
  history.add_row({0.1, 3.});

  // Read while the file is still open, as after a run that was killed.
  std::ifstream     in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  BOOST_CHECK_EQUAL(text, "time [s],force [N]\n0,1.25e-07\n0.1,3\n");
  BOOST_CHECK_EQUAL(history.n_rows(), 2u);

  BOOST_CHECK_EXCEPTION(
      history.add_row({0.2, std::numeric_limits<double>::infinity()}),
      NumericalError,
      [](const auto &e) {
        return std::string(e.what()).find("force [N]") != std::string::npos;
      });
  BOOST_CHECK_THROW(Output::History("/nonexistent/history.csv", {"a"}),
                    FileError);
}


BOOST_AUTO_TEST_CASE(tables_are_written_whole)
{
  const auto folder =
      std::filesystem::temp_directory_path() / "morsel_unit_history";
  std::filesystem::create_directories(folder);
  const auto file = (folder / "fragments.csv").string();
  Output::write_table(file, {"fragment", "area [mm2]"}, {{0., 1.5}, {1., 1.}});
  std::ifstream     in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  BOOST_CHECK_EQUAL(text, "fragment,area [mm2]\n0,1.5\n1,1\n");
}
