#include "bite.h"
#include "experiment_run.h"
#include "recorder.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/command_line.h>
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/signals.h>
#include <morsel/simulation.h>

#include <chrono>
#include <iomanip>
#include <sstream>

namespace Morsel
{
  namespace
  {
    /// Steps that a run is expected to take.
    double
    expected_steps(const Scene::Scene &scene, const Bite &bite)
    {
      double speed = 0., ramp = 0.;
      for (const auto &plate : scene.rigid_bodies)
        {
          speed += plate.motion.velocity.norm();
          ramp = std::max(ramp, plate.motion.ramp_time);
        }
      const auto  &body    = scene.particle_bodies.front();
      const double height  = body.shape.extent(bite.closing_axis());
      double       closure = scene.stop.maximum_closure * height;
      if (body.damage.enabled)
        closure = std::min(
            closure,
            1.3 * expected_failure_closure(scene, bite.closing_axis()) +
                scene.stop.closure_after_failure * height);
      const double time = speed > 0. ? std::min(scene.time.end_time,
                                                closure / speed + 0.5 * ramp)
                                     : scene.time.end_time;
      return std::ceil(time / bite.time_step());
    }
  } // namespace


  void
  run_simulation(const Scene::Scene &scene, const RunOptions &options)
  {
    if (scene.rigid_bodies.empty())
      {
        run_experiment(scene, options);
        return;
      }
    const FirstRank writer;
    writer.run([&] { prepare_output_directory(options.output_directory); });
    const MPI_Comm communicator = MPI_COMM_WORLD;
    const bool     first_rank =
        dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    RunLog log(
        options.output_directory + "/run.log", options.quiet, first_rank);
    if (first_rank)
      write_atomically(options.output_directory + "/used.prm",
                       scene.used_parameters);
    log << scene.title << '\n';
    for (const auto &advice : scene.warnings)
      log.warning(advice);

    Bite bite(scene, communicator, log);
    {
      std::ostringstream text;
      text << bite.particle_count() << " particles, step " << bite.time_step()
           << " s, " << options.threads << " threads on "
           << dealii::Utilities::MPI::n_mpi_processes(communicator)
           << " rank(s). Effects:\n";
      text << Output::effects_as_text(effects_of(scene));
      log << text.str();
    }

    bite.evaluate();
    Recorder   recorder(scene, options, bite, log, communicator);
    StopReason reason = StopReason::none;
    for (bool go_on = true; go_on;)
      {
        recorder.follow();
        log.progress(recorder.progress(), bite.time(), bite.step());
        reason = recorder.stop_reason();
        go_on  = reason == StopReason::none &&
                !dealii::Utilities::MPI::max(
                    static_cast<int>(interrupt_requested()), communicator);
        if (go_on)
          {
            bite.advance();
            bite.evaluate();
          }
      }
    recorder.finish(reason);
    log.print_wall_times();
    if (reason == StopReason::none)
      throw Interrupted("Interrupted at " + std::to_string(1e3 * bite.time()) +
                        " ms; the results so far are in '" +
                        options.output_directory + "'.");
  }


  std::string
  describe_run(const Scene::Scene &scene)
  {
    if (scene.rigid_bodies.empty())
      return describe_experiment(scene);
    const MPI_Comm communicator = MPI_COMM_WORLD;
    RunLog         log("", true, false);
    Bite           bite(scene, communicator, log);

    // A few steps, thrown away, tell what a step costs here and now.
    constexpr unsigned int trial_steps = 20;
    bite.evaluate();
    const auto begin = std::chrono::steady_clock::now();
    for (unsigned int k = 0; k < trial_steps; ++k)
      {
        bite.advance();
        bite.evaluate();
      }
    const double per_step =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
            .count() /
        trial_steps;

    const double       steps = expected_steps(scene, bite);
    std::ostringstream text;
    text << "Scene '" << scene.name << "' is sound. Effects:\n";
    text << Output::effects_as_text(effects_of(scene)) << "Time step        "
         << bite.time_step() << " s\n"
         << "Particles        " << bite.particle_count() << '\n'
         << "Cells            " << bite.food().get_host().n_cells()
         << " (background mesh)\n"
         << "Steps            about " << steps << " of at most "
         << std::ceil(scene.time.end_time / bite.time_step()) << '\n'
         << "Predicted time   about " << std::setprecision(2)
         << 1.3 * per_step * steps << " s\n";
    return text.str();
  }
} // namespace Morsel
