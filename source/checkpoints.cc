#include "checkpoints.h"

#include <morsel/core/failure.h>
#include <morsel/core/signals.h>

#include <algorithm>

namespace Morsel
{
  Checkpoints::Checkpoints(const Scene::Scene &scene,
                           const RunOptions   &options,
                           const MPI_Comm      communicator)
      : scene(scene)
      , resume(options.resume)
      , communicator(communicator)
      , several_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      , folder(options.output_directory + "/checkpoint",
               scene.output.checkpoints_kept,
               communicator)
      , last(Clock::now())
  {
    if (resume)
      loaded = folder.read_newest({scene.name, scene.used_parameters, 0, 0.},
                                  complaints);
  }


  void
  Checkpoints::begin(RunLog &run_log)
  {
    log = &run_log;
    for (const auto &complaint : complaints)
      log->warning(complaint);
    if (resume)
      return;
    std::string place;
    FirstRank().run([&] { place = folder.set_aside(); });
    if (!place.empty())
      log->warning("Checkpoints of an earlier run were moved to '" + place +
                   "'.");
  }


  Partition
  Checkpoints::partition()
  {
    Partition result;
    if (resume)
      loaded.same(result);
    return result;
  }


  void
  Checkpoints::finish_loading()
  {
    if (!loaded.at_end())
      throw FileError("--resume: the checkpoint holds more than this scene "
                      "has; it is of another version of the program.");
    loaded = StateArchive();
  }


  void
  Checkpoints::log_beginning(const unsigned long long step, const double time)
  {
    *log << "Goes on from the checkpoint of step " << step << ", time " << time
         << " s.\n";
  }


  bool
  Checkpoints::is_due(const unsigned long long step)
  {
    // Ranks have to agree, which costs as much as a small step.
    if (several_ranks && step % steps_between_wishes != 0)
      return false;
    if (interrupt_requested())
      wish = Wish::stop;
    else if (take_checkpoint_request())
      wish = std::max(wish, Wish::checkpoint);
    else if (const double interval = 60. * scene.output.checkpoint_interval;
             interval > 0. &&
             std::chrono::duration<double>(Clock::now() - last).count() >
                 interval)
      wish = std::max(wish, Wish::checkpoint);
    wish = static_cast<Wish>(
        dealii::Utilities::MPI::max(static_cast<int>(wish), communicator));
    return wish != Wish::nothing;
  }


  void
  Checkpoints::save(StateArchive            &state,
                    const unsigned long long step,
                    const double             time)
  {
    const auto timer = log->section("checkpoints");
    log->exchange_state(state);
    try
      {
        folder.write({scene.name, scene.used_parameters, step, time},
                     state.buffer());
      }
    catch (const FileError &error)
      {
        throw FileError(error.what() + advice());
      }
    last = Clock::now();
    if (wish == Wish::checkpoint)
      wish = Wish::nothing;
  }


  std::string
  Checkpoints::advice() const
  {
    return folder.newest().empty()
               ? ""
               : " --resume goes on from '" + folder.newest() + "'.";
  }
} // namespace Morsel
