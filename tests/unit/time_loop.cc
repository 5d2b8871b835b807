// The control of the step, and the loop over time on an oscillator whose step
// is too large: what is taken back, what is saved, and that a run which goes on
// from a checkpoint steps back as the whole one does.

#include "../../source/time_loop.h"
#include "../../source/checkpoints.h"
#include "sentences.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/state_archive.h>
#include <morsel/core/step_clock.h>

#include <boost/test/unit_test.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <thread>

using namespace Morsel;

namespace
{
  /// u'' = -w^2 u by leapfrog, with w = 1 and u = 1 at rest at first.
  class Oscillator
  {
  public:
    explicit Oscillator(const double time_step)
    {
      clock.set_time_step(time_step);
    }

    void
    evaluate()
    {
      acceleration = -u;
    }

    void
    advance()
    {
      v += clock.kick() * acceleration;
      u += clock.time_step() * v;
      clock.advance();
    }

    double
    time() const
    {
      return clock.time();
    }
    double
    time_step() const
    {
      return clock.time_step();
    }
    double
    safe_time_step() const
    {
      return 1.;
    }
    unsigned long long
    step() const
    {
      return clock.step();
    }

    void
    change_time_step(const double time_step)
    {
      clock.set_time_step(time_step);
    }

    GuardedSystem
    guarded() const
    {
      return {{}, {}, 0., 100., MPI_COMM_SELF};
    }

    std::vector<const SPH::Solid *>
    shared_bodies() const
    {
      return {};
    }

    Measure::Energies
    energies() const
    {
      Measure::Energies e;
      const double      whole = v + clock.lag() * acceleration;
      e.kinetic               = 0.5 * whole * whole;
      e.strain                = 0.5 * u * u;
      return e;
    }

    void
    exchange_state(StateArchive &state)
    {
      state.same(clock, u, v, acceleration);
    }

    double u = 1.;

  private:
    double    v = 0., acceleration = 0.;
    StepClock clock;
  };


  class Notes
  {
  public:
    explicit Notes(const Oscillator &system)
        : system(system)
        , ledger(system.energies())
    {}

    bool
    samples_now() const
    {
      return false;
    }
    bool
    records_now() const
    {
      return true;
    }

    void
    follow()
    {
      times.push_back(system.time());
      if (on_follow)
        on_follow(system);
    }

    double
    progress() const
    {
      return system.time() / 10.;
    }

    bool
    finished() const
    {
      return system.time() >= 10.;
    }

    const Measure::EnergyLedger &
    energy_ledger() const
    {
      return ledger;
    }

    void
    exchange_state(StateArchive &state)
    {
      state.same(times);
    }

    std::vector<double>                     times;
    std::function<void(const Oscillator &)> on_follow;

  private:
    const Oscillator     &system;
    Measure::EnergyLedger ledger;
  };


  struct Loop
  {
    Loop(const double                                   time_step,
         const unsigned int                             retries,
         const std::function<void(const Oscillator &)> &on_follow   = {},
         Checkpoints                                   *checkpoints = nullptr)
        : log("", true, false)
    {
      if (checkpoints)
        checkpoints->begin(log);
      loop = std::make_unique<TimeLoop<Oscillator, Notes>>(
          [time_step](const Partition &) {
            return std::make_unique<Oscillator>(time_step);
          },
          [on_follow](Oscillator &system) {
            auto notes       = std::make_unique<Notes>(system);
            notes->on_follow = on_follow;
            return notes;
          },
          LoopSettings{retries, true},
          checkpoints,
          log,
          MPI_COMM_SELF);
      report = loop->run();
    }

    const Oscillator &
    system() const
    {
      return loop->get_system();
    }

    const std::vector<double> &
    times() const
    {
      return loop->get_recorder().times;
    }

    RunLog                                       log;
    std::unique_ptr<TimeLoop<Oscillator, Notes>> loop;
    LoopReport                                   report;
  };


  /// What is thrown where a run is killed.
  struct Killed
  {
  };


  /// A folder of results with checkpoints, gone with this object.
  struct Folder
  {
    Folder()
    {
      std::filesystem::remove_all(name);
      create_folder(name);
      scene.name = "oscillator";
    }

    ~Folder()
    {
      std::filesystem::remove_all(name);
    }

    /// @param minutes between checkpoints; 0: none
    Checkpoints
    checkpoints(const bool resume, const double minutes)
    {
      scene.output.checkpoint_interval = minutes;
      RunOptions options;
      options.output_directory = name;
      options.resume           = resume;
      return {scene, options, MPI_COMM_SELF};
    }

    const std::string name = "time_loop_test";
    Scene::Scene      scene;
  };
} // namespace

BOOST_AUTO_TEST_SUITE(time_loop)

BOOST_AUTO_TEST_CASE(steps_may_change)
{
  StepClock    clock;
  const double dt = 1.7e-7;
  clock.set_time_step(dt);
  BOOST_TEST(clock.kick() == 0.5 * dt);
  for (unsigned int k = 1; k <= 1000; ++k)
    {
      clock.advance();
      BOOST_TEST_REQUIRE(clock.time() == k * dt);
      BOOST_TEST_REQUIRE(clock.kick() == dt);
    }
  const double then = clock.time();
  clock.set_time_step(0.5 * dt);
  BOOST_TEST(clock.kick() == 0.75 * dt);
  for (unsigned int k = 1; k <= 1000; ++k)
    {
      clock.advance();
      BOOST_TEST_REQUIRE(clock.time() == then + k * (0.5 * dt));
    }
  BOOST_TEST(clock.kick() == 0.5 * dt);
  BOOST_TEST(clock.step() == 2000u);
}


BOOST_AUTO_TEST_CASE(the_same_failure_leads_further_back)
{
  StepControl   control(10);
  const Finding finding{Finding::Kind::energy, "", "", ""};
  for (unsigned long long step = 0; step <= 20000; ++step)
    if (control.wants_state(step))
      control.keep({{}, "", "", 1e-6 * step, step, 1e-6});
  const Moment first{20100e-6, 20100, 1e-6, 1e-5};
  const auto  *state = control.retry(finding, first);
  BOOST_REQUIRE(state);
  BOOST_TEST(state->step == 20000u);
  BOOST_TEST(control.time_step() == 0.5e-6);
  // The same once more, then from well before, then it must be something else.
  const Moment second{20120e-6, 20240, 0.5e-6, 1e-5};
  state = control.retry(finding, second);
  BOOST_REQUIRE(state);
  BOOST_TEST(state->step <= 15000u);
  BOOST_TEST(control.time_step() == 0.25e-6);
  BOOST_TEST(!control.retry(finding, Moment{20110e-6, 36000, 0.25e-6, 1e-5}));
}


BOOST_AUTO_TEST_CASE(a_later_failure_begins_anew)
{
  StepControl   control(10);
  const Finding finding{Finding::Kind::energy, "", "", ""};
  control.keep({{}, "", "", 0., 0, 1e-6});
  BOOST_TEST(control.retry(finding, {1e-3, 1000, 1e-6, 1e-5})->step == 0u);
  control.keep({{}, "", "", 2e-3, 4000, 0.5e-6});
  BOOST_TEST(control.retry(finding, {3e-3, 6000, 0.5e-6, 1e-5})->step == 4000u);
}


BOOST_AUTO_TEST_CASE(no_more_retries_than_allowed)
{
  const Finding finding{Finding::Kind::energy, "", "", ""};
  StepControl   none(0), two(2);
  for (StepControl *control : {&none, &two})
    control->keep({{}, "", "", 0., 0, 1e-6});
  const Moment moment{1e-5, 10, 1e-4, 1e-6};
  BOOST_TEST(!none.retry(finding, moment));
  BOOST_TEST(two.retry(finding, moment));
  BOOST_TEST(two.retry(finding, moment));
  BOOST_TEST(!two.retry(finding, moment));
  StepControl of_step(4);
  BOOST_TEST(!of_step.retry({Finding::Kind::step, "", "", ""}, moment));
}


BOOST_AUTO_TEST_CASE(the_loop_saves_a_run_from_its_step)
{
  const Loop run(18., 8);
  BOOST_TEST(run.report.failure == "");
  BOOST_TEST(run.report.step_retries >= 4u);
  BOOST_TEST(run.report.first_time_step == 18.);
  const auto &times = run.times();
  BOOST_TEST(times.front() == 0.);
  for (unsigned int k = 1; k < times.size(); ++k)
    BOOST_TEST_REQUIRE(times[k] > times[k - 1]);
  BOOST_TEST(times.back() >= 10.);
  const double dt = run.system().time_step();
  BOOST_TEST(dt == std::ldexp(18., -static_cast<int>(run.report.step_retries)));
  BOOST_TEST(std::abs(run.system().u - std::cos(run.system().time())) < 0.5);
}


BOOST_AUTO_TEST_CASE(the_loop_stops_at_once_if_told_so)
{
  const Loop run(18., 0);
  BOOST_TEST(run.report.step_retries == 0u);
  check_says(run.report.failure,
             {"the time step of 18 s, 18 times",
              "the last good state, of time 0 s, step 0"});
  BOOST_TEST(run.system().time() == 0.);
}


BOOST_AUTO_TEST_CASE(the_loop_gives_up_where_no_step_helps)
{
  const Loop run(0.25, 4, [](const Oscillator &system) {
    if (system.time() > 3.)
      throw NumericalError("No equilibrium.");
  });
  BOOST_TEST(run.report.step_retries >= 1u);
  check_says(run.report.failure, {"No equilibrium, at time 3.", "step"});
  // Ends with the last good state.
  BOOST_TEST(run.times().empty());
}


BOOST_AUTO_TEST_CASE(a_run_that_goes_on_steps_back_as_the_whole_one)
{
  // Steps of 1 ms fail, those of 0.5 ms fail at the same time, to which the
  // run then comes from well before.
  const auto fails = [](const Oscillator &system) {
    if (system.time() > 0.25 && system.time_step() > 3e-4)
      throw NumericalError("No equilibrium.");
  };
  const Loop whole(1e-3, 4, fails);
  BOOST_TEST(whole.report.failure == "");
  BOOST_TEST(whole.report.step_retries == 2u);
  for (const double step_when_killed : {1e-3, 0.5e-3})
    {
      Folder folder;
      {
        auto often = folder.checkpoints(false, 1e-9);
        BOOST_CHECK_THROW(Loop(
                              1e-3,
                              4,
                              [&](const Oscillator &system) {
                                fails(system);
                                if (system.time() > 0.23 &&
                                    system.time_step() == step_when_killed)
                                  throw Killed();
                              },
                              &often),
                          Killed);
      }
      auto       checkpoints = folder.checkpoints(true, 0.);
      const Loop rest(1e-3, 4, fails, &checkpoints);
      BOOST_TEST(rest.report.failure == "");
      BOOST_TEST(rest.report.step_retries == 2u);
      BOOST_TEST(rest.system().u == whole.system().u);
      BOOST_TEST(rest.times() == whole.times(),
                 boost::test_tools::per_element());
    }
}


BOOST_AUTO_TEST_CASE(only_good_states_are_saved)
{
  // The first step is bad already.
  Folder     folder;
  auto       often = folder.checkpoints(false, 1e-9);
  const Loop run(18., 0, {}, &often);
  check_says(run.report.failure,
             {"kept in 'time_loop_test/checkpoint/step_000000000000.json'"});
  unsigned int n_lists = 0;
  for (const auto &entry :
       std::filesystem::directory_iterator("time_loop_test/checkpoint"))
    n_lists += entry.path().extension() == ".json";
  BOOST_TEST(n_lists == 1u);
}


BOOST_AUTO_TEST_CASE(a_loop_that_is_set_up_again_is_the_same_loop)
{
  RunLog log("", true, false);
  log.begin_loop();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  log.begin_loop();
  BOOST_TEST(log.loop_wall_time() >= 0.02);
}

BOOST_AUTO_TEST_SUITE_END()
