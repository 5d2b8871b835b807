#ifndef morsel_source_checkpoints_h
#define morsel_source_checkpoints_h

#include "run_state.h"

#include <morsel/core/log.h>
#include <morsel/core/run_options.h>
#include <morsel/output/checkpoint.h>
#include <morsel/scene/scene.h>

#include <chrono>
#include <string>

namespace Morsel
{
  /// When a run in time saves its state, and how it goes on from one.
  ///
  /// The state is that between a step and the next evaluation of forces; the
  /// run sees to it that it is a good one.
  class Checkpoints
  {
  public:
    /// For a run that goes on, reads the newest good checkpoint at once,
    /// before anything is written; collective.
    /// @throws InputError, FileError as CheckpointFolder::read_newest().
    Checkpoints(const Scene::Scene &scene,
                const RunOptions   &options,
                MPI_Comm            communicator);

    /// Once there is a log: tells what was read, or moves what an earlier run
    /// left out of the way. Collective.
    void
    begin(RunLog &log);

    /// Whether the run goes on from a checkpoint.
    bool
    resumes() const
    {
      return resume;
    }

    /// That the state of the run which goes on belongs to; before restore().
    Partition
    partition();

    /// Brings a run that has just been set up to where it was.
    /// @param run with load(StateArchive &), step() and time()
    template <typename Run>
    void
    restore(Run &run)
    {
      run.load(loaded);
      log->exchange_state(loaded);
      finish_loading();
      log_beginning(run.step(), run.time());
    }

    /// Whether the state is to be saved: it is time to, or somebody has asked
    /// for it since the last save. Collective, after every step.
    bool
    is_due(unsigned long long step);

    /// Whether the run has to end then, because it is interrupted.
    bool
    ends_run() const
    {
      return wish == Wish::stop;
    }

    /// Saves a state; collective.
    /// @param state as load() of the run takes it, to which the log is added
    void
    save(StateArchive &state, unsigned long long step, double time);

    /// The newest, as it can be named to the user; empty if there is none.
    const std::string &
    newest() const
    {
      return folder.newest();
    }

    /// "; --resume goes on from 'FILE'" or nothing.
    std::string
    advice() const;

  private:
    enum class Wish
    {
      nothing,
      checkpoint,
      stop
    };

    void
    finish_loading();

    void
    log_beginning(unsigned long long step, double time);

    using Clock = std::chrono::steady_clock;

    static constexpr unsigned int steps_between_wishes = 16;

    const Scene::Scene      &scene;
    const bool               resume;
    const MPI_Comm           communicator;
    const bool               several_ranks;
    Output::CheckpointFolder folder;
    StateArchive             loaded; ///< what restore() has not taken yet
    std::vector<std::string> complaints;
    RunLog                  *log  = nullptr;
    Wish                     wish = Wish::nothing; ///< of any rank
    Clock::time_point        last;
  };
} // namespace Morsel

#endif
