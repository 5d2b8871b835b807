#include "experiment_run.h"

#include "checkpoints.h"
#include "experiment.h"
#include "experiment_recorder.h"
#include "run_beginning.h"
#include "static_run.h"
#include "time_loop.h"
#include "trial_steps.h"

#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/suggestions.h>
#include <morsel/measure/crack_gauge.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

namespace Morsel
{
  namespace
  {
    /// Adds what stress intensities in every sample take.
    void
    predict_gauges(const Scene::Scene &scene,
                   const Experiment   &experiment,
                   Prediction         &prediction)
    {
      const double samples =
          std::min<double>(scene.output.history_samples, prediction.steps);
      for (unsigned int b = 0; b < scene.particle_bodies.size(); ++b)
        {
          if (scene.particle_bodies[b].cracks.paths.empty())
            continue;
          std::unique_ptr<Measure::CrackGauge> gauge;
          const Times                          set_up = time_of([&] {
            gauge = std::make_unique<Measure::CrackGauge>(
                scene.particle_bodies[b], *experiment.bodies()[b], scene.seed);
          });
          const Times reading = time_of([&] { gauge->evaluate(); });
          prediction.seconds += set_up.wall + samples * reading.wall;
          prediction.processor_seconds +=
              set_up.processor + samples * reading.processor;
        }
    }
  } // namespace


  void
  run_experiment(const Scene::Scene &scene, const RunOptions &options)
  {
    if (scene.time.is_static())
      {
        run_static(scene, options);
        return;
      }
    const MPI_Comm communicator = MPI_COMM_WORLD;
    Checkpoints    checkpoints(scene, options, communicator);
    RunLog         log("", options.quiet, FirstRank().is_this_rank());
    TimeLoop<Experiment, ExperimentRecorder> loop(
        [&](const Partition &partition) {
          return std::make_unique<Experiment>(
              scene, communicator, log, partition);
        },
        [&](Experiment &system) {
          return std::make_unique<ExperimentRecorder>(
              scene, options, system, log, communicator);
        },
        {scene.time.retries, scene.ranks.repartition},
        &checkpoints,
        log,
        communicator);
    begin_results(scene, options, checkpoints, log);
    Experiment        &experiment = loop.get_system();
    std::ostringstream text;
    text << experiment.particle_count() << " particles, step "
         << experiment.time_step() << " s"
         << share_of_measured_step(experiment, scene.time.end_time, log)
         << scaled_mass_text(scene) << "; " << options.threads << " threads on "
         << dealii::Utilities::MPI::n_mpi_processes(communicator)
         << " rank(s). Effects:\n"
         << Output::effects_as_text(effects_of_experiment(scene));
    log << text.str();

    const LoopReport report = loop.run();
    loop.get_recorder().finish(report);
    log.print_wall_times();
    end_run(report,
            loop.get_system().time(),
            "the results so far are in '" + options.output_directory + "'." +
                checkpoints.advice());
  }


  Prediction
  predict_experiment(const Scene::Scene &scene)
  {
    if (scene.time.is_static())
      return predict_static(scene);
    RunLog       log("", true, false);
    Experiment   experiment(scene, MPI_COMM_WORLD, log);
    const double steps =
        std::ceil(scene.time.end_time / experiment.time_step());
    Prediction prediction;
    prediction.scene   = scene.name;
    prediction.effects = Output::effects_as_text(effects_of_experiment(scene));
    prediction.advice  = scene.warnings;
    prediction.counts.emplace_back("Time step",
                                   number_text(experiment.time_step()) + " s");
    prediction.count("Particles", experiment.particle_count());
    prediction.count("Steps", steps);
    prediction.unknowns = 2. * experiment.particle_count();
    prediction.steps    = steps;
    predict_steps(prediction,
                  scene,
                  experiment.particle_count(),
                  trial_step_time(experiment, steps),
                  steps);
    predict_gauges(scene, experiment, prediction);
    return prediction;
  }
} // namespace Morsel
