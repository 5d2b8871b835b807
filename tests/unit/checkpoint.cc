// A run that goes on from its saved state is the run that was never
// interrupted, bit by bit, whatever the scene is made of.

#include "../../source/bite.h"
#include "../../source/experiment.h"
#include "../../source/experiment_recorder.h"
#include "../../source/recorder.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/run_options.h>
#include <morsel/output/checkpoint.h>
#include <morsel/scene/read.h>

#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>

namespace
{
  using namespace Morsel;

  const std::string source = MORSEL_SOURCE_DIR;


  /// A scene, coarse, and after how many steps it is interrupted and ends.
  struct Case
  {
    std::string              file;
    std::vector<std::string> overrides;
    unsigned int             stop, end;
  };


  std::ostream &
  operator<<(std::ostream &out, const Case &c)
  {
    return out << c.file;
  }


  template <typename System, typename Recorder>
  struct Run;

  template <>
  struct Run<Bite, Recorder>
  {
    Run(const Scene::Scene &scene, const RunOptions &options)
        : log("", true, false)
        , system(scene, MPI_COMM_WORLD, log)
        , recorder((system.evaluate(), scene),
                   options,
                   system,
                   log,
                   MPI_COMM_WORLD)
    {}

    RunLog   log;
    Bite     system;
    Recorder recorder;
  };

  template <>
  struct Run<Experiment, ExperimentRecorder>
  {
    Run(const Scene::Scene &scene, const RunOptions &options)
        : log("", true, false)
        , system(scene, MPI_COMM_SELF, log)
        , recorder((system.evaluate(), scene),
                   options,
                   system,
                   log,
                   MPI_COMM_SELF)
    {}

    RunLog             log;
    Experiment         system;
    ExperimentRecorder recorder;
  };


  template <typename AnyRun>
  void
  take_steps(AnyRun &run, const unsigned int n_steps)
  {
    for (unsigned int k = 0; k < n_steps; ++k)
      {
        if (k > 0)
          run.system.evaluate();
        run.recorder.follow();
        run.system.advance();
      }
  }


  template <typename AnyRun>
  std::string
  state_of(AnyRun &run)
  {
    StateArchive archive;
    run.system.exchange_state(archive);
    run.recorder.exchange_state(archive);
    return archive.buffer();
  }


  template <typename System, typename AnyRecorder>
  void
  check(const Case &c)
  {
    const std::string folder = "checkpoint_test";
    create_folder(folder);
    RunOptions options;
    options.output_directory = folder;
    const Scene::Scene scene =
        Scene::read_scene_on_all_ranks(source + "/" + c.file, c.overrides);

    std::string between, at_end;
    {
      Run<System, AnyRecorder> run(scene, options);
      take_steps(run, c.stop);
      between = state_of(run);
      run.system.evaluate();
      take_steps(run, c.end - c.stop);
      at_end = state_of(run);
    }
    BOOST_TEST((at_end != between));

    Run<System, AnyRecorder> run(scene, options);
    StateArchive             archive(between);
    run.system.exchange_state(archive);
    run.recorder.exchange_state(archive);
    BOOST_TEST(archive.at_end());
    BOOST_TEST((state_of(run) == between));
    run.system.evaluate();
    take_steps(run, c.end - c.stop);
    BOOST_TEST((state_of(run) == at_end));
    std::filesystem::remove_all(folder);
  }


  const std::vector<Case> bites = {
      {"tests/regression/damaged_stroke.prm", {}, 900, 1500},
      {"tests/regression/elastic_stroke.prm", {}, 100, 200},
      {"tests/regression/elastic_grains.prm", {}, 60, 160},
      {"tests/regression/elastic_plates.prm", {}, 50, 120},
      {"tests/regression/cusped_stroke.prm", {}, 60, 160},
      {"tests/regression/jaw_bite.prm", {}, 60, 160},
      {"tests/regression/cracked_tooth_coarse.prm", {}, 30, 70}};

  const std::vector<Case> experiments = {
      {"tests/regression/beam_coarse.prm", {}, 60, 160},
      {"tests/regression/breaking_bar.prm", {}, 300, 500},
      {"tests/regression/branching_coarse.prm", {}, 200, 350},
      {"tests/regression/grady_kipp_block.prm", {}, 100, 200},
      {"tests/regression/bending_coarse.prm", {}, 50, 120}};
} // namespace


BOOST_AUTO_TEST_SUITE(checkpoint)

BOOST_DATA_TEST_CASE(bites_go_on, boost::unit_test::data::make(bites), c)
{
  check<Bite, Recorder>(c);
}


BOOST_DATA_TEST_CASE(experiments_go_on,
                     boost::unit_test::data::make(experiments),
                     c)
{
  check<Experiment, ExperimentRecorder>(c);
}


BOOST_AUTO_TEST_CASE(archives_take_other_owners)
{
  // Two ranks with two particles each.
  const auto save = [](std::vector<unsigned long long> ids,
                       std::vector<double>             values,
                       double                          part) {
    StateArchive archive;
    double       common = 7.;
    archive.name_particles(ids, ids.size());
    archive.particles(values);
    archive.sum(part);
    archive.same(common);
    archive.cache(values);
    return archive.buffer();
  };
  StateArchive archive(
      {save({3, 1}, {30., 10.}, 1.), save({0, 2}, {0., 20.}, 2.)},
      MPI_COMM_SELF);
  std::vector<unsigned long long> ids = {0, 1, 2, 3};
  std::vector<double>             values(4), kept = {5.};
  double                          sum = 0., common = 0.;
  archive.name_particles(ids, 4);
  archive.particles(values);
  archive.sum(sum);
  archive.same(common);
  BOOST_TEST(!archive.cache(kept));
  BOOST_TEST(archive.at_end());
  BOOST_TEST(values == std::vector<double>({0., 10., 20., 30.}),
             boost::test_tools::per_element());
  BOOST_TEST(sum == 3.);
  BOOST_TEST(common == 7.);
  BOOST_TEST(kept == std::vector<double>({5.}),
             boost::test_tools::per_element());
}


BOOST_AUTO_TEST_CASE(foreign_states_are_refused)
{
  StateArchive saved;
  double       number = 1.;
  saved.same(number);
  const std::string buffer = saved.buffer();
  {
    StateArchive       archive(buffer);
    std::vector<float> floats;
    BOOST_CHECK_THROW(archive.same(floats), FileError);
  }
  {
    StateArchive archive(buffer.substr(0, 12));
    BOOST_CHECK_THROW(archive.same(number), FileError);
  }
  {
    StateArchive archive(buffer);
    archive.same(number);
    BOOST_CHECK_THROW(archive.same(number), FileError);
  }
}


BOOST_AUTO_TEST_CASE(damaged_checkpoints_give_way_to_older_ones)
{
  const std::string folder = "checkpoint_folder_test";
  std::filesystem::remove_all(folder);
  Output::CheckpointFolder checkpoints(folder, 2, MPI_COMM_SELF);
  for (const unsigned int step : {1, 2, 3})
    checkpoints.write({"scene", "set a = 1\n", step, 0.1 * step},
                      "state " + std::to_string(step));
  BOOST_TEST(!std::filesystem::exists(folder + "/step_000000000001.json"));
  BOOST_TEST(!std::filesystem::exists(folder + "/step_000000000001.rank0"));

  const auto newest = [&](const std::string &parameters) {
    std::vector<std::string> complaints;
    checkpoints.read_newest({"scene", parameters, 0, 0.}, complaints);
    return complaints;
  };
  BOOST_TEST(newest("set a = 1\n").empty());
  BOOST_CHECK_EXCEPTION(
      newest("set a = 2\n"), InputError, [](const InputError &error) {
        return std::string(error.what())
                   .find("the scene now says 'set a = 2'") != std::string::npos;
      });

  std::ofstream(folder + "/step_000000000003.rank0") << "statX 3";
  BOOST_TEST(newest("set a = 1\n").size() == 1u);
  std::ofstream(folder + "/step_000000000002.json") << "{";
  BOOST_CHECK_THROW(newest("set a = 1\n"), FileError);
  BOOST_TEST(checkpoints.set_aside() == folder + "_before");
  BOOST_CHECK_THROW(newest("set a = 1\n"), InputError);
  std::filesystem::remove_all(folder + "_before");
}

BOOST_AUTO_TEST_SUITE_END()
