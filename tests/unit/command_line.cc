// The command line, the folder of results and the run log.
#include <morsel/core/command_line.h>
#include <morsel/core/errors.h>
#include <morsel/core/log.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

using namespace Morsel;

namespace
{
  std::string
  temporary(const std::string &name)
  {
    return (std::filesystem::temp_directory_path() /
            (name + std::to_string(getpid())))
        .string();
  }
} // namespace


BOOST_AUTO_TEST_SUITE(command_line)

BOOST_AUTO_TEST_CASE(options_are_read)
{
  const CommandLine line = read_command_line({"--set",
                                              "Depth=1",
                                              "a.prm",
                                              "--set",
                                              "Time/End time=2",
                                              "--output",
                                              "there",
                                              "--threads",
                                              "3",
                                              "--quiet",
                                              "--validate"});
  BOOST_TEST(line.scene_file == "a.prm");
  BOOST_REQUIRE_EQUAL(line.overrides.size(), 2u);
  BOOST_TEST(line.overrides[0] == "Depth=1");
  BOOST_TEST(line.overrides[1] == "Time/End time=2");
  BOOST_TEST(line.run.output_directory == "there");
  BOOST_TEST(line.run.threads == 3u);
  BOOST_TEST(line.run.quiet);
  BOOST_TEST(line.run.validate_only);
  BOOST_TEST(!line.resume);
  BOOST_TEST(line.message.empty());
}


BOOST_AUTO_TEST_CASE(bad_calls_are_refused)
{
  for (const std::vector<std::string> &arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"--wrong", "a.prm"},
                                             {"a.prm", "b.prm"},
                                             {"a.prm", "--threads", "0"},
                                             {"a.prm", "--threads", "many"},
                                             {"a.prm", "--set"},
                                             {"--print-parameters", "xml"}})
    BOOST_CHECK_THROW(read_command_line(arguments), InputError);
}


BOOST_AUTO_TEST_CASE(the_folder_of_results_is_made_and_left_empty)
{
  const std::string folder = temporary("morsel-results-");
  prepare_output_directory(folder + "/a/b");
  BOOST_TEST(std::filesystem::is_empty(folder + "/a/b"));
  std::ofstream(folder + "/file") << "text";
  BOOST_CHECK_THROW(prepare_output_directory(folder + "/file"), FileError);
  BOOST_CHECK_THROW(prepare_output_directory("/proc/morsel"), FileError);
  std::filesystem::remove_all(folder);
}


BOOST_AUTO_TEST_CASE(the_log_keeps_text_progress_and_times)
{
  const std::string file = temporary("morsel-log-");
  {
    RunLog log(file, true, true);
    log << "particles: " << 3 << std::endl;
    log.warning("slow down");
    for (unsigned int i = 0; i <= 1000; ++i)
      {
        const auto timer = log.section("loop");
        log.progress(i / 1000., 1e-6 * i, i);
      }
    for (unsigned int i = 0; i < 2; ++i)
      {
        const auto timer = log.section("sleep");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    const auto times = log.wall_times();
    BOOST_REQUIRE_EQUAL(times.size(), 2u);
    BOOST_TEST(times[0].first == "loop");
    BOOST_TEST(times[1].second >= 0.02);
    BOOST_TEST(times[1].second <= log.wall_time());
    log.print_wall_times();
  }
  std::ifstream      stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  std::filesystem::remove(file);

  BOOST_TEST(text.str().find("particles: 3\nAdvice: slow down\n") == 0u);
  unsigned int n_progress_lines = 0;
  for (std::size_t i = 0;
       (i = text.str().find("  t = ", i)) != std::string::npos;
       ++i)
    ++n_progress_lines;
  BOOST_TEST(n_progress_lines == 11u);
  BOOST_TEST(text.str().find("whole run") != std::string::npos);
}


BOOST_AUTO_TEST_CASE(an_impossible_log_is_a_failure_of_files)
{
  BOOST_CHECK_THROW(RunLog("/nowhere/run.log", true, true), FileError);
}

BOOST_AUTO_TEST_SUITE_END()
