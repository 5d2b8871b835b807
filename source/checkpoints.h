#ifndef morsel_source_checkpoints_h
#define morsel_source_checkpoints_h

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
  /// The state is that between a step and the next evaluation of forces.
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

    /// Brings a run that has just been set up to where it was.
    /// @param run with exchange_state(), step() and time()
    template <typename Run>
    void
    restore(Run &run)
    {
      run.exchange_state(loaded);
      log->exchange_state(loaded);
      finish_loading();
      log_beginning(run.step(), run.time());
    }

    /// Saves the state where it is time to, or somebody asks for it; call it
    /// after every step. Collective.
    /// @return whether the run has to end because it is interrupted
    template <typename Run>
    bool
    after_step(Run &run)
    {
      // Ranks have to agree, which costs as much as a small step.
      if (several_ranks && run.step() % steps_between_wishes != 0)
        return false;
      const Wish wish = wish_of_all();
      if (wish != Wish::nothing)
        save(run);
      return wish == Wish::stop;
    }

    /// Saves the state now; collective.
    template <typename Run>
    void
    save(Run &run)
    {
      StateArchive state;
      {
        const auto timer = log->section("checkpoints");
        run.exchange_state(state);
        log->exchange_state(state);
      }
      write(run.step(), run.time(), state.buffer());
    }

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

    Wish
    wish_of_all();

    void
    write(unsigned long long step, double time, const std::string &state);

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
    StateArchive             loaded;
    std::vector<std::string> complaints;
    RunLog                  *log = nullptr;
    Clock::time_point        last;
  };
} // namespace Morsel

#endif
