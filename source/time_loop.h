#ifndef morsel_source_time_loop_h
#define morsel_source_time_loop_h

#include "checkpoints.h"
#include "guards.h"
#include "loop_report.h"
#include "step_control.h"

#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/state_archive.h>
#include <morsel/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>
#include <sstream>
#include <utility>

namespace Morsel
{
  /// @param object with exchange_state(StateArchive &)
  template <typename Object>
  std::string
  saved_state(Object &object)
  {
    StateArchive archive;
    object.exchange_state(archive);
    return std::move(archive).buffer();
  }


  template <typename Object>
  void
  load_state(Object &object, const std::string &saved)
  {
    StateArchive archive({saved}, true, true);
    object.exchange_state(archive);
  }


  /// The loop over time of a mechanical system (Bite, Experiment) and the
  /// recorder that follows it, with guards, step control and checkpoints.
  ///
  /// States are those between a system's advance() and evaluate(): from there a
  /// run can go on with another step. They are loaded into a system and a
  /// recorder that have just been made, as for a run that is resumed.
  template <typename System, typename Recorder>
  class TimeLoop
  {
  public:
    using MakeSystem   = std::function<std::unique_ptr<System>()>;
    using MakeRecorder = std::function<std::unique_ptr<Recorder>(System &)>;

    /// @param make_recorder is called when the system has been evaluated once
    /// @param checkpoints or null for none
    TimeLoop(MakeSystem                   make_system,
             MakeRecorder                 make_recorder,
             const Scene::TimeParameters &time,
             Checkpoints                 *checkpoints,
             RunLog                      &log,
             MPI_Comm                     communicator);

    /// Until the recorder says that the run is finished, SIGINT or SIGTERM
    /// arrive, or a guard stops it: then the system is in its last good state
    /// and the report says what happened. Collective.
    LoopReport
    run();

    /// @name Of the run that a checkpoint is loaded into.
    ///@{
    void
    load(StateArchive &state);

    unsigned long long
    step() const
    {
      return system->step();
    }

    double
    time() const
    {
      return system->time();
    }
    ///@}

    System &
    get_system()
    {
      return *system;
    }

    Recorder &
    get_recorder()
    {
      return *recorder;
    }

  private:
    /// Evaluates the new system and makes its recorder; or goes on from a
    /// checkpoint.
    void
    begin();

    /// Forces at the present positions, and what the guards say to them.
    /// @param thoroughly whatever the number of the step
    std::optional<Finding>
    evaluate_and_check(bool thoroughly);

    std::optional<Finding>
    check(bool thoroughly);

    /// A ledger has to be open for some steps.
    std::optional<Finding>
    check_energy(const Measure::Energies &energies);

    /// One step. States are kept and saved once the guards have found them
    /// good; a checkpoint that is due waits for that. @param interrupted is set
    std::optional<Finding>
    take_step(bool &interrupted);

    /// Follows; what the recorder finds is a finding, too.
    std::optional<Finding>
    follow();

    /// Takes what one rank alone throws.
    template <typename Work>
    std::optional<Finding>
    finding_of(const Work &work) const;

    Moment
    moment() const;

    RunState
    state();

    /// What has to be kept of the loop itself.
    void
    exchange_state(StateArchive &state);

    /// @param good state that the guards have found so
    void
    save(const RunState &good);

    /// @param time_step to go on with [s]
    void
    go_back(const RunState &good, double time_step);

    /// @return whether the loop goes on
    bool
    retreat(const Finding &finding);

    /// Back to the last good state, which is kept. @return where
    std::string
    keep_last_good();

    /// That the ledger is open, and the step that showed it first.
    struct Suspicion
    {
      Finding            finding;
      unsigned long long since;
    };

    const MakeSystem          make_system;
    const MakeRecorder        make_recorder;
    Checkpoints *const        checkpoints;
    RunLog                   &log;
    const MPI_Comm            communicator;
    std::unique_ptr<System>   system;
    std::unique_ptr<Guards>   guards;
    StepControl               control;
    std::unique_ptr<Recorder> recorder;
    std::optional<Suspicion>  suspicion;
    unsigned long long        energy_known = 0; ///< step of the last check
    LoopReport                report;
  };


  /// Contacts are looked at every so many steps, particles and the energy
  /// ledger, whose sums cost most of a step, more seldom, unless the recorder
  /// makes these anyway.
  constexpr unsigned int steps_between_contact_checks  = 20;
  constexpr unsigned int steps_between_particle_checks = 40;
  constexpr unsigned int steps_between_energy_checks   = 96;

  /// Velocities that jump as prescribed open the ledger for one step.
  constexpr unsigned int steps_of_suspicion = 2;


  template <typename System, typename Recorder>
  TimeLoop<System, Recorder>::TimeLoop(MakeSystem   make_system,
                                       MakeRecorder make_recorder,
                                       const Scene::TimeParameters &time,
                                       Checkpoints                 *checkpoints,
                                       RunLog                      &log,
                                       const MPI_Comm communicator)
      : make_system(std::move(make_system))
      , make_recorder(std::move(make_recorder))
      , checkpoints(checkpoints)
      , log(log)
      , communicator(communicator)
      , system(this->make_system())
      , guards(std::make_unique<Guards>(system->guarded()))
      , control(time.retries)
  {
    report.first_time_step = system->time_step();
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::begin()
  {
    if (const auto finding = guards->check_step(moment()))
      throw NumericalError(sentence(*finding, moment(), {}));
    RunState at_first;
    at_first.system = saved_state(*system);
    system->evaluate();
    recorder           = make_recorder(*system);
    at_first.recorder  = saved_state(*recorder);
    at_first.time_step = system->time_step();
    if (checkpoints && checkpoints->resumes())
      {
        const double of_scene = system->time_step();
        checkpoints->restore(*this);
        if (of_scene != report.first_time_step)
          {
            // The scene says another step than before.
            report.first_time_step = of_scene;
            control.forget_tries();
            system->change_time_step(of_scene);
          }
        at_first = state();
        system->evaluate();
      }
    if (!control.last_good())
      control.keep(std::move(at_first));
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::load(StateArchive &state)
  {
    system->exchange_state(state);
    recorder->exchange_state(state);
    exchange_state(state);
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::exchange_state(StateArchive &state)
  {
    control.exchange_state(state);
    state.same(report.step_retries, report.first_time_step);
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::save(const RunState &good)
  {
    StateArchive archive;
    archive.append(good.system);
    archive.append(good.recorder);
    exchange_state(archive);
    checkpoints->save(archive, good.step, good.time);
  }


  template <typename System, typename Recorder>
  LoopReport
  TimeLoop<System, Recorder>::run()
  {
    begin();
    bool                   interrupted = false;
    std::optional<Finding> finding     = check(true);
    for (;;)
      {
        if (!finding && !interrupted)
          finding = follow();
        const bool finished = !finding && recorder->finished();
        if (!finding && !finished && !interrupted)
          log.progress(recorder->progress(), system->time(), system->step());
        else if (!finding)
          finding = check(true);
        if (!finding && finished && suspicion)
          finding = suspicion->finding;
        if (!finding && (finished || interrupted))
          {
            report.interrupted = !finished;
            return report;
          }
        if (finding && !retreat(*finding))
          return report;
        finding = finding ? evaluate_and_check(true) : take_step(interrupted);
      }
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  TimeLoop<System, Recorder>::take_step(bool &interrupted)
  {
    system->advance();
    const bool keeps = control.wants_state(system->step());
    const bool saves = checkpoints && checkpoints->is_due(system->step());
    if (!keeps && !saves)
      return evaluate_and_check(false);
    RunState   now     = state();
    const auto finding = evaluate_and_check(true);
    if (finding || suspicion)
      return finding;
    // From a state in which noise has begun to grow no step would save the run.
    if (keeps &&
        guards->closes_well(system->energies(), recorder->energy_ledger()))
      control.keep(saves ? RunState(now) : std::move(now));
    if (saves)
      {
        save(now);
        interrupted = checkpoints->ends_run();
      }
    return {};
  }


  template <typename System, typename Recorder>
  template <typename Work>
  std::optional<Finding>
  TimeLoop<System, Recorder>::finding_of(const Work &work) const
  {
    // Several ranks might not throw together.
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      return work();
    try
      {
        return work();
      }
    catch (const NumericalError &error)
      {
        std::string what = error.what();
        while (!what.empty() && what.back() == '.')
          what.pop_back();
        return Finding{Finding::Kind::solver, what, "", ""};
      }
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  TimeLoop<System, Recorder>::evaluate_and_check(const bool thoroughly)
  {
    return finding_of([&] {
      system->evaluate();
      return check(thoroughly);
    });
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  TimeLoop<System, Recorder>::follow()
  {
    const bool samples = recorder->samples_now();
    return finding_of([&]() -> std::optional<Finding> {
      recorder->follow();
      if (!samples)
        return {};
      return check_energy(recorder->energy_ledger().last());
    });
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  TimeLoop<System, Recorder>::check(const bool thoroughly)
  {
    const auto timer   = log.section("guards");
    const auto is_time = [&](const unsigned int steps) {
      return thoroughly || system->step() % steps == 0 ||
             recorder->records_now();
    };
    if (is_time(steps_between_particle_checks))
      if (const auto finding = guards->check_particles())
        return finding;
    if (is_time(steps_between_contact_checks))
      if (const auto finding = guards->check_contacts())
        return finding;
    if (!thoroughly && !suspicion &&
        system->step() < energy_known + steps_between_energy_checks)
      return {};
    return check_energy(system->energies());
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  TimeLoop<System, Recorder>::check_energy(const Measure::Energies &energies)
  {
    energy_known = system->step();
    const auto finding =
        guards->check_energy(energies, recorder->energy_ledger());
    if (!finding)
      suspicion.reset();
    if (!finding || finding->kind != Finding::Kind::energy)
      return finding;
    if (!suspicion)
      suspicion = Suspicion{*finding, system->step()};
    if (system->step() < suspicion->since + steps_of_suspicion)
      return {};
    return finding;
  }


  template <typename System, typename Recorder>
  Moment
  TimeLoop<System, Recorder>::moment() const
  {
    return {system->time(),
            system->step(),
            system->time_step(),
            system->safe_time_step()};
  }


  template <typename System, typename Recorder>
  RunState
  TimeLoop<System, Recorder>::state()
  {
    const auto timer = log.section("good states");
    return {saved_state(*system),
            saved_state(*recorder),
            system->time(),
            system->step(),
            system->time_step()};
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::go_back(const RunState &good,
                                      const double    time_step)
  {
    recorder.reset();
    guards.reset();
    system = make_system();
    guards = std::make_unique<Guards>(system->guarded());
    system->evaluate();
    recorder = make_recorder(*system);
    load_state(*system, good.system);
    load_state(*recorder, good.recorder);
    energy_known = system->step();
    suspicion.reset();
    if (time_step != system->time_step())
      system->change_time_step(time_step);
  }


  template <typename System, typename Recorder>
  bool
  TimeLoop<System, Recorder>::retreat(const Finding &finding)
  {
    const Moment          bad  = moment();
    const RunState *const good = control.retry(finding, bad);
    log.end_progress();
    if (good)
      {
        ++report.step_retries;
        std::ostringstream text;
        text << finding.what << ", at time " << bad.time << " s, step "
             << bad.step << ". Back to time " << good->time << " s, step "
             << good->step << ", and on with steps of " << control.time_step()
             << " s instead of " << bad.time_step << " s (retry "
             << report.step_retries << ").";
        log.warning(text.str());
        go_back(*good, control.time_step());
        return true;
      }
    report.failure =
        sentence(finding, bad, {control.steps_tried(), keep_last_good()});
    return false;
  }


  template <typename System, typename Recorder>
  std::string
  TimeLoop<System, Recorder>::keep_last_good()
  {
    const RunState &good = *control.last_good();
    go_back(good, good.time_step);
    std::ostringstream text;
    text << "the results end with the last good state, of time " << good.time
         << " s, step " << good.step;
    if (checkpoints)
      try
        {
          save(good);
          text << ", which is kept in '" << checkpoints->newest() << "'";
        }
      catch (const FileError &)
        {
          text << ", which could not be written";
        }
    system->evaluate();
    return text.str();
  }
} // namespace Morsel

#endif
