#ifndef morsel_source_live_run_h
#define morsel_source_live_run_h

#include "guards.h"
#include "run_state.h"

#include <morsel/core/log.h>
#include <morsel/core/state_archive.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace Morsel
{
  /// What a time loop moves: a mechanical system (Bite, Experiment), the
  /// recorder that follows it and the guards that look at it. Makes them, keeps
  /// their states and brings these back.
  ///
  /// States are those between a system's advance() and evaluate(): from there a
  /// run can go on with another step. They are loaded into a system and a
  /// recorder that have just been made, as for a run that is resumed.
  template <typename System, typename Recorder>
  class LiveRun
  {
  public:
    using MakeSystem =
        std::function<std::unique_ptr<System>(const Partition &)>;
    using MakeRecorder = std::function<std::unique_ptr<Recorder>(System &)>;

    /// @param make_recorder is called when the system has been evaluated once
    LiveRun(MakeSystem       make_system,
            MakeRecorder     make_recorder,
            const Partition &partition,
            RunLog          &log,
            MPI_Comm         communicator);

    /// Evaluates the new system and makes its recorder. @return the state
    /// before that
    RunState
    begin();

    /// Of this moment.
    RunState
    state() const;

    /// From a checkpoint.
    void
    load(StateArchive &archive);

    /// @param time_step to go on with [s]
    void
    go_back(const RunState &state, double time_step);

    /// What the guards say of this moment, after an evaluation.
    /// @param thoroughly whatever the number of the step
    std::optional<Finding>
    check(bool thoroughly);

    /// A ledger has to be open for some steps.
    std::optional<Finding>
    check_energy(const Measure::Energies &energies);

    /// That the ledger is open, but not for so long.
    std::optional<Finding>
    suspicion() const
    {
      if (!suspected)
        return {};
      return suspected->finding;
    }

    /// Goes on with the same state, on the ranks that @p partition says.
    void
    move_to(const Partition &partition);

    Moment
    moment() const;

    std::unique_ptr<System>   system;
    std::unique_ptr<Guards>   guards;
    std::unique_ptr<Recorder> recorder;

  private:
    /// As at first.
    void
    renew();

    /// That the ledger is open, and the step that showed it first.
    struct Suspicion
    {
      Finding            finding;
      unsigned long long since;
    };

    const MakeSystem   make_system;
    const MakeRecorder make_recorder;
    RunLog            &log;
    const MPI_Comm     communicator;
    Partition          partition;

    std::optional<Suspicion> suspected;
    unsigned long long       energy_known = 0; ///< step of the last check
  };


  /// Contacts are looked at every so many steps, particles and the energy
  /// ledger, whose sums cost most of a step, more seldom, unless the recorder
  /// makes these anyway.
  constexpr unsigned int steps_between_contact_checks  = 20;
  constexpr unsigned int steps_between_particle_checks = 40;
  constexpr unsigned int steps_between_energy_checks   = 96;

  /// Velocities that jump as prescribed open the ledger for one step.
  constexpr unsigned int steps_of_suspicion = 2;


  template <typename Object>
  std::string
  saved_state(Object &object)
  {
    StateArchive archive;
    object.exchange_state(archive);
    return std::move(archive).buffer();
  }


  template <typename System, typename Recorder>
  LiveRun<System, Recorder>::LiveRun(MakeSystem       make_system,
                                     MakeRecorder     make_recorder,
                                     const Partition &partition,
                                     RunLog          &log,
                                     const MPI_Comm   communicator)
      : system(make_system(partition))
      , guards(std::make_unique<Guards>(system->guarded()))
      , make_system(std::move(make_system))
      , make_recorder(std::move(make_recorder))
      , log(log)
      , communicator(communicator)
      , partition(partition)
  {}


  template <typename System, typename Recorder>
  RunState
  LiveRun<System, Recorder>::begin()
  {
    RunState at_first;
    at_first.partition = partition;
    at_first.system    = saved_state(*system);
    system->evaluate();
    recorder           = make_recorder(*system);
    at_first.recorder  = saved_state(*recorder);
    at_first.time_step = system->time_step();
    return at_first;
  }


  template <typename System, typename Recorder>
  RunState
  LiveRun<System, Recorder>::state() const
  {
    const auto timer = log.section("good states");
    return {partition,
            saved_state(*system),
            saved_state(*recorder),
            system->time(),
            system->step(),
            system->time_step()};
  }


  template <typename System, typename Recorder>
  void
  LiveRun<System, Recorder>::load(StateArchive &archive)
  {
    system->exchange_state(archive);
    recorder->exchange_state(archive);
  }


  template <typename System, typename Recorder>
  void
  LiveRun<System, Recorder>::renew()
  {
    recorder.reset();
    guards.reset();
    system.reset();
    system = make_system(partition);
    guards = std::make_unique<Guards>(system->guarded());
    system->evaluate();
    recorder = make_recorder(*system);
  }


  template <typename System, typename Recorder>
  void
  LiveRun<System, Recorder>::go_back(const RunState &state,
                                     const double    time_step)
  {
    partition = state.partition;
    renew();
    StateArchive of_system(state.system), of_recorder(state.recorder);
    system->exchange_state(of_system);
    recorder->exchange_state(of_recorder);
    if (time_step != system->time_step())
      system->change_time_step(time_step);
    energy_known = state.step;
    suspected.reset();
  }


  template <typename System, typename Recorder>
  void
  LiveRun<System, Recorder>::move_to(const Partition &better)
  {
    const auto               timer = log.section("repartitioning");
    std::vector<std::string> of_system(1, saved_state(*system)),
        of_recorder(1, saved_state(*recorder));
    partition = better;
    renew();
    StateArchive system_archive(std::move(of_system), communicator),
        recorder_archive(std::move(of_recorder), communicator);
    system->exchange_state(system_archive);
    recorder->exchange_state(recorder_archive);
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  LiveRun<System, Recorder>::check(const bool thoroughly)
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
    if (!thoroughly && !suspected &&
        system->step() < energy_known + steps_between_energy_checks)
      return {};
    return check_energy(system->energies());
  }


  template <typename System, typename Recorder>
  std::optional<Finding>
  LiveRun<System, Recorder>::check_energy(const Measure::Energies &energies)
  {
    energy_known = system->step();
    const auto finding =
        guards->check_energy(energies, recorder->energy_ledger());
    if (!finding)
      suspected.reset();
    if (!finding || finding->kind != Finding::Kind::energy)
      return finding;
    if (!suspected)
      suspected = Suspicion{*finding, system->step()};
    if (system->step() < suspected->since + steps_of_suspicion)
      return {};
    return finding;
  }


  template <typename System, typename Recorder>
  Moment
  LiveRun<System, Recorder>::moment() const
  {
    return {system->time(),
            system->step(),
            system->time_step(),
            system->safe_time_step()};
  }
} // namespace Morsel

#endif
