// The guards on made-up bad states, the control of the step, and the loop over
// time on an oscillator whose step is too large.

#include "../../source/bite.h"
#include "../../source/time_loop.h"
#include "solid_scene.h"

#include <morsel/core/state_archive.h>

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace Morsel;

namespace
{
  constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

  const Moment safe{2e-3, 340, 1e-6, 1e-6};


  /// A body with guards over it.
  struct Guarded
  {
    explicit Guarded(const char *law = "neo-Hookean")
        : scene(SPH::scene_of_block(8, 8, 1e-3, 0.3))
    {
      scene.particle_bodies[0].material.law = law;
      body                                  = std::make_unique<SPH::Solid>(
          scene.particle_bodies[0], scene, MPI_COMM_SELF);
      system.bodies       = {{"block", body.get()}};
      system.end_time     = 1.;
      system.communicator = MPI_COMM_SELF;
    }

    std::optional<Finding>
    check() const
    {
      return Guards(system).check_particles();
    }

    SPH::Particles &
    particles()
    {
      return state_of(*body);
    }

    Scene::Scene                scene;
    std::unique_ptr<SPH::Solid> body;
    GuardedSystem               system;
  };


  void
  check_says(const std::string &text, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      BOOST_TEST((text.find(part) != std::string::npos),
                 "'" << text << "' does not say '" << part << "'");
    BOOST_TEST(text.find('\n') == std::string::npos);
    BOOST_TEST(text.back() == '.');
  }


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
      if (system.time() > breaks_at)
        throw NumericalError("No equilibrium.");
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

    std::vector<double> times;
    double              breaks_at = std::numeric_limits<double>::infinity();

  private:
    const Oscillator     &system;
    Measure::EnergyLedger ledger;
  };


  struct Loop
  {
    Loop(const double       time_step,
         const unsigned int retries,
         const double       breaks_at = std::numeric_limits<double>::infinity())
        : log("", true, false)
    {
      Scene::TimeParameters time;
      time.retries = retries;
      loop         = std::make_unique<TimeLoop<Oscillator, Notes>>(
          [time_step] { return std::make_unique<Oscillator>(time_step); },
          [breaks_at](Oscillator &system) {
            auto notes       = std::make_unique<Notes>(system);
            notes->breaks_at = breaks_at;
            return notes;
          },
          time,
          nullptr,
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
} // namespace

BOOST_AUTO_TEST_SUITE(guards)

BOOST_AUTO_TEST_CASE(a_sound_state_passes)
{
  Guarded           g;
  const Guards      guards(g.system);
  Measure::Energies e;
  BOOST_TEST(!g.check());
  BOOST_TEST(!guards.check_step(safe));
  BOOST_TEST(!guards.check_energy(e, Measure::EnergyLedger(e)));
}


BOOST_AUTO_TEST_CASE(what_is_not_finite_is_named)
{
  for (double Motion::*entry :
       {&Motion::u_x, &Motion::u_y, &Motion::v_x, &Motion::v_y})
    for (const double bad :
         {nan_value, std::numeric_limits<double>::infinity()})
      {
        Guarded g;
        g.particles().motion[17].*entry = bad;
        const auto finding              = g.check();
        BOOST_REQUIRE(finding);
        BOOST_TEST((finding->kind == Finding::Kind::not_finite));
        check_says(sentence(*finding, safe, {}),
                   {"'block'",
                    "not finite",
                    "particle 17, at first at (",
                    "at time 0.002 s, step 340",
                    "the likely cause is "});
      }
}


BOOST_AUTO_TEST_CASE(a_particle_inside_out_is_named)
{
  Guarded g;
  g.particles().gradient[9].xx = -1.5;
  const auto finding           = g.check();
  BOOST_REQUIRE(finding);
  BOOST_TEST((finding->kind == Finding::Kind::inverted));
  check_says(sentence(*finding, safe, {}),
             {"'block' has turned inside out", "particle 9"});

  // The small-strain law may be scaled at will.
  Guarded linear("linear");
  linear.particles().gradient[9].xx = -1.5;
  BOOST_TEST(!linear.check());
}


BOOST_AUTO_TEST_CASE(a_runaway_particle_is_named)
{
  Guarded      g;
  const double c              = g.body->get_material().wave_speed;
  g.particles().motion[3].v_y = -1.99 * c;
  BOOST_TEST(!g.check());
  g.particles().motion[3].v_y = -2.01 * c;
  const auto finding          = g.check();
  BOOST_REQUIRE(finding);
  BOOST_TEST((finding->kind == Finding::Kind::too_fast));
  check_says(sentence(*finding, safe, {}), {"runs away", "particle 3", " m/s"});

  // What the scene throws may be as fast as it is thrown.
  g.system.given_speed = 0.1 * c;
  BOOST_TEST(!g.check());
}


BOOST_AUTO_TEST_CASE(deep_contact_is_named)
{
  Guarded g;
  double  depth     = 0.9e-3;
  g.system.contacts = {{"block", "tooth", [&] { return depth; }, 1e-3}};
  BOOST_TEST(!g.check());
  for (const double d : {1.1e-3, nan_value})
    {
      depth              = d;
      const auto finding = g.check();
      BOOST_REQUIRE(finding);
      BOOST_TEST((finding->kind == Finding::Kind::too_deep));
      check_says(
          sentence(*finding, safe, {}),
          {"Body 'block' is ", "deep in 'tooth'", "'Contact/Stiffness'"});
    }
}


BOOST_AUTO_TEST_CASE(energy_from_nowhere_is_named)
{
  Guarded               g;
  const Guards          guards(g.system);
  Measure::EnergyLedger ledger{Measure::Energies()};
  Measure::Energies     e;
  const double          unit = 100. * guards.noticeable_energy();
  e.external_work            = unit;
  e.strain                   = 1.09 * unit;
  BOOST_TEST(!guards.check_energy(e, ledger));
  for (const double strain : {1.2, 0.85, nan_value})
    {
      e.strain           = strain * unit;
      const auto finding = guards.check_energy(e, ledger);
      BOOST_REQUIRE(finding);
      BOOST_TEST((finding->kind == (std::isfinite(strain)
                                        ? Finding::Kind::energy
                                        : Finding::Kind::not_finite)));
      check_says(sentence(*finding, safe, {}),
                 {std::isfinite(strain) ? "energy ledger does not close"
                                        : "energy is not finite"});
    }
  // First touches may be rough.
  e.external_work = 0.;
  e.strain        = 0.9 * guards.noticeable_energy();
  BOOST_TEST(!guards.check_energy(e, ledger));
}


BOOST_AUTO_TEST_CASE(a_step_that_leads_nowhere_is_named)
{
  Guarded      g;
  const Guards guards(g.system);
  for (const double dt : {0., 1e-13, nan_value, -1.})
    {
      const Moment moment{0., 0, dt, dt};
      const auto   finding = guards.check_step(moment);
      BOOST_REQUIRE(finding);
      check_says(sentence(*finding, moment, {}), {"The time step has become"});
    }
}


BOOST_AUTO_TEST_CASE(the_worst_is_named_first)
{
  Guarded g;
  g.particles().motion[3].v_y  = 1e9;
  g.particles().gradient[5].yy = -3.;
  g.particles().motion[40].u_x = nan_value;
  BOOST_TEST((g.check()->kind == Finding::Kind::not_finite));
  g.particles().motion[40].u_x = 0.;
  BOOST_TEST((g.check()->kind == Finding::Kind::inverted));
}


BOOST_AUTO_TEST_CASE(the_sentence_blames_what_it_knows)
{
  const Finding finding{
      Finding::Kind::too_fast, "It runs", "a load", "lower it"};
  check_says(sentence(finding, {1., 2, 1e-5, 1e-6}, {}),
             {"the time step of 1e-05 s, 10 times", "'Time/Time step'"});
  check_says(sentence(finding, safe, {}),
             {"is a load, or the step of 1e-06 s; lower it"});
  check_says(sentence(finding, safe, {{5e-7, 2.5e-7}, "all is lost"}),
             {"steps down to 2.5e-07 s ended alike",
              "is a load, not the step; lower it; all is lost."});
}


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
      control.keep({"", "", 1e-6 * step, step, 1e-6});
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
  control.keep({"", "", 0., 0, 1e-6});
  BOOST_TEST(control.retry(finding, {1e-3, 1000, 1e-6, 1e-5})->step == 0u);
  control.keep({"", "", 2e-3, 4000, 0.5e-6});
  BOOST_TEST(control.retry(finding, {3e-3, 6000, 0.5e-6, 1e-5})->step == 4000u);
}


BOOST_AUTO_TEST_CASE(no_more_retries_than_allowed)
{
  const Finding finding{Finding::Kind::energy, "", "", ""};
  StepControl   none(0), two(2);
  for (StepControl *control : {&none, &two})
    control->keep({"", "", 0., 0, 1e-6});
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
  const Loop run(0.25, 4, 3.);
  BOOST_TEST(run.report.step_retries >= 1u);
  check_says(run.report.failure, {"No equilibrium, at time 3.", "step"});
  // Ends with the last good state.
  BOOST_TEST(run.times().empty());
}

BOOST_AUTO_TEST_SUITE_END()
