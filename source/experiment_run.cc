#include "experiment_run.h"

#include "experiment.h"
#include "experiment_recorder.h"
#include "static_run.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/command_line.h>
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/signals.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace Morsel
{
  void
  run_experiment(const Scene::Scene &scene, const RunOptions &options)
  {
    if (scene.time.is_static())
      {
        run_static(scene, options);
        return;
      }
    FirstRank().run(
        [&] { prepare_output_directory(options.output_directory); });
    RunLog log(options.output_directory + "/run.log", options.quiet, true);
    write_atomically(options.output_directory + "/used.prm",
                     scene.used_parameters);
    log << scene.title << '\n';
    for (const auto &advice : scene.warnings)
      log.warning(advice);

    Experiment         experiment(scene, log);
    std::ostringstream text;
    text << experiment.particle_count() << " particles, step "
         << experiment.time_step() << " s, " << options.threads
         << " threads. Effects:\n"
         << Output::effects_as_text(effects_of_experiment(scene));
    log << text.str();

    experiment.evaluate();
    ExperimentRecorder recorder(scene, options, experiment, log);
    bool               interrupted = false;
    for (;;)
      {
        recorder.follow();
        log.progress(std::min(1., experiment.time() / scene.time.end_time),
                     experiment.time(),
                     experiment.step());
        interrupted = interrupt_requested();
        if (interrupted || recorder.finished())
          break;
        experiment.advance();
        experiment.evaluate();
      }
    recorder.finish();
    log.print_wall_times();
    if (interrupted)
      throw Interrupted("Interrupted at " + std::to_string(experiment.time()) +
                        " s; the results so far are in '" +
                        options.output_directory + "'.");
  }


  std::string
  describe_experiment(const Scene::Scene &scene)
  {
    if (scene.time.is_static())
      return describe_static(scene);
    RunLog     log("", true, false);
    Experiment experiment(scene, log);

    // A few steps, thrown away, tell what a step costs here and now.
    constexpr unsigned int trial_steps = 20;
    experiment.evaluate();
    const auto begin = std::chrono::steady_clock::now();
    for (unsigned int k = 0; k < trial_steps; ++k)
      {
        experiment.advance();
        experiment.evaluate();
      }
    const double per_step =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
            .count() /
        trial_steps;

    const double steps =
        std::ceil(scene.time.end_time / experiment.time_step());
    std::ostringstream text;
    text << "Scene '" << scene.name << "' is sound. Effects:\n"
         << Output::effects_as_text(effects_of_experiment(scene))
         << "Time step        " << experiment.time_step() << " s\n"
         << "Particles        " << experiment.particle_count() << '\n'
         << "Steps            " << steps << '\n';
    text.precision(2);
    text << "Predicted time   about " << 1.1 * per_step * steps << " s\n";
    return text.str();
  }
} // namespace Morsel
