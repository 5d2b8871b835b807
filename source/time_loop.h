#ifndef morsel_source_time_loop_h
#define morsel_source_time_loop_h

#include "checkpoints.h"
#include "live_run.h"
#include "loop_report.h"
#include "rank_balance.h"
#include "step_control.h"

#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/state_archive.h>
#include <morsel/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <sstream>
#include <utility>

namespace Morsel
{
  struct LoopSettings
  {
    unsigned int retries;     ///< with half the step, at most
    bool         repartition; ///< of particles, where that pays
  };


  /// The loop over time of a mechanical system (Bite, Experiment) and the
  /// recorder that follows it, with guards, step control, checkpoints and a
  /// look at the balance of the ranks.
  template <typename System, typename Recorder>
  class TimeLoop
  {
  public:
    using MakeSystem   = typename LiveRun<System, Recorder>::MakeSystem;
    using MakeRecorder = typename LiveRun<System, Recorder>::MakeRecorder;

    /// @param make_system,make_recorder see LiveRun
    /// @param checkpoints or null for none
    TimeLoop(MakeSystem          make_system,
             MakeRecorder        make_recorder,
             const LoopSettings &settings,
             Checkpoints        *checkpoints,
             RunLog             &log,
             MPI_Comm            communicator);

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
      return live.system->step();
    }

    double
    time() const
    {
      return live.system->time();
    }
    ///@}

    System &
    get_system()
    {
      return *live.system;
    }

    Recorder &
    get_recorder()
    {
      return *live.recorder;
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

    /// What has to be kept of the loop itself.
    void
    exchange_state(StateArchive &state);

    /// @param good state that the guards have found so
    void
    save(const RunState &good);

    /// Other owners for the particles, if that is worth it.
    void
    share_out_anew();

    /// @return whether the loop goes on
    bool
    retreat(const Finding &finding);

    /// Back to the last good state, which is kept. @return where
    std::string
    keep_last_good();

    Checkpoints *const        checkpoints;
    RunLog                   &log;
    const MPI_Comm            communicator;
    LiveRun<System, Recorder> live;
    StepControl               control;
    RankBalance               balance;
    LoopReport                report;
  };


  template <typename System, typename Recorder>
  TimeLoop<System, Recorder>::TimeLoop(MakeSystem          make_system,
                                       MakeRecorder        make_recorder,
                                       const LoopSettings &settings,
                                       Checkpoints        *checkpoints,
                                       RunLog             &log,
                                       const MPI_Comm      communicator)
      : checkpoints(checkpoints)
      , log(log)
      , communicator(communicator)
      , live(std::move(make_system),
             std::move(make_recorder),
             checkpoints ? checkpoints->partition() : Partition(),
             log,
             communicator)
      , control(settings.retries)
      , balance(settings.repartition, communicator)
  {
    report.first_time_step = live.system->time_step();
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::begin()
  {
    if (const auto finding = live.guards->check_step(live.moment()))
      throw NumericalError(sentence(*finding, live.moment(), {}));
    RunState at_first = live.begin();
    if (checkpoints && checkpoints->resumes())
      {
        const double of_scene = live.system->time_step();
        checkpoints->restore(*this);
        if (of_scene != report.first_time_step)
          {
            // The scene says another step than before.
            report.first_time_step = of_scene;
            control.forget_tries();
            live.system->change_time_step(of_scene);
          }
        at_first = live.state();
        live.system->evaluate();
      }
    if (!control.last_good())
      control.keep(std::move(at_first));
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::load(StateArchive &state)
  {
    live.load(state);
    exchange_state(state);
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::exchange_state(StateArchive &state)
  {
    control.exchange_state(state);
    balance.exchange_state(state);
    state.same(
        report.step_retries, report.repartitions, report.first_time_step);
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::save(const RunState &good)
  {
    StateArchive archive;
    Partition    partition = good.partition;
    archive.same(partition);
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
    std::optional<Finding> finding     = live.check(true);
    for (;;)
      {
        if (!finding && !interrupted)
          finding = follow();
        const bool finished = !finding && live.recorder->finished();
        if (!finding && !finished && !interrupted)
          log.progress(live.recorder->progress(),
                       live.system->time(),
                       live.system->step());
        else if (!finding)
          finding = live.check(true);
        if (!finding && finished)
          finding = live.suspicion();
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
    live.system->advance();
    share_out_anew();
    const bool keeps = control.wants_state(live.system->step());
    const bool saves = checkpoints && checkpoints->is_due(live.system->step());
    if (!keeps && !saves)
      return evaluate_and_check(false);
    RunState   now     = live.state();
    const auto finding = evaluate_and_check(true);
    if (finding || live.suspicion())
      return finding;
    // From a state in which noise has begun to grow no step would save the run.
    if (keeps && live.guards->closes_well(live.system->energies(),
                                          live.recorder->energy_ledger()))
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
      live.system->evaluate();
      return live.check(thoroughly);
    });
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  TimeLoop<System, Recorder>::follow()
  {
    const bool samples = live.recorder->samples_now();
    return finding_of([&]() -> std::optional<Finding> {
      live.recorder->follow();
      if (!samples)
        return {};
      return live.check_energy(live.recorder->energy_ledger().last());
    });
  }


  template <typename System, typename Recorder>
  void
  TimeLoop<System, Recorder>::share_out_anew()
  {
    if (!balance.is_due(live.system->step()))
      return;
    const auto better = balance.better_partition(live.system->shared_bodies());
    if (!better)
      return;
    live.move_to(*better);
    ++report.repartitions;
    log << "Particles changed ranks at time " << live.system->time()
        << " s, step " << live.system->step() << ".\n";
  }


  template <typename System, typename Recorder>
  bool
  TimeLoop<System, Recorder>::retreat(const Finding &finding)
  {
    const Moment          bad  = live.moment();
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
        live.go_back(*good, control.time_step());
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
    live.go_back(good, good.time_step);
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
    live.system->evaluate();
    return text.str();
  }
} // namespace Morsel

#endif
