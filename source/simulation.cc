#include "bite.h"
#include "checkpoints.h"
#include "costs.h"
#include "elastic_plates.h"
#include "experiment_run.h"
#include "recorder.h"
#include "run_beginning.h"
#include "time_loop.h"
#include "trial_steps.h"

#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/suggestions.h>
#include <morsel/simulation.h>

#include <sstream>

namespace Morsel
{
  namespace
  {
    /// How far the plates close, and how fast.
    struct Course
    {
      double speed = 0.; ///< [m/s]
      /// Of how far plates would close that always had their speed, how much
      /// they have not [m].
      double behind = 0.;
      /// Until the run ends, and until the food fails [m].
      double closure = 0., failure = 0.;

      /// When they have closed so far, or the run ends [s].
      double
      time_of(const double distance, const double end_time) const
      {
        return speed > 0. ? std::min(end_time, (distance + behind) / speed)
                          : end_time;
      }
    };


    Course
    expected_course(const Scene::Scene &scene, const unsigned int axis)
    {
      Course course;
      for (const auto &plate : scene.plate_bodies)
        {
          course.speed += plate.motion.typical_velocity().norm();
          course.behind +=
              plate.motion.typical_velocity().norm() * plate.motion.delay();
        }
      const auto  &body   = scene.particle_bodies.front();
      const double height = body.shape.extent(axis);
      course.closure      = scene.stop.maximum_closure * height;
      course.failure      = course.closure;
      if (body.damage.enabled)
        {
          course.failure = std::min(
              course.closure, 1.3 * expected_failure_closure(scene, axis));
          course.closure = std::min(
              course.closure,
              course.failure + scene.stop.closure_after_failure * height);
        }
      return course;
    }
  } // namespace


  void
  run_simulation(const Scene::Scene &scene, const RunOptions &options)
  {
    if (scene.plate_bodies.empty())
      {
        run_experiment(scene, options);
        return;
      }
    check_cracked_bodies(scene);
    const MPI_Comm           communicator = MPI_COMM_WORLD;
    Checkpoints              checkpoints(scene, options, communicator);
    RunLog                   log("", options.quiet, FirstRank().is_this_rank());
    TimeLoop<Bite, Recorder> loop(
        [&](const Partition &partition) {
          return std::make_unique<Bite>(scene, communicator, log, partition);
        },
        [&](Bite &system) {
          return std::make_unique<Recorder>(
              scene, options, system, log, communicator);
        },
        {scene.time.retries, scene.ranks.repartition},
        &checkpoints,
        log,
        communicator);
    begin_results(scene, options, checkpoints, log);
    {
      Bite              &bite = loop.get_system();
      std::ostringstream text;
      text << bite.particle_count() << " particles, step " << bite.time_step()
           << " s" << share_of_measured_step(bite, scene.time.end_time, log)
           << scaled_mass_text(scene) << "; " << options.threads
           << " threads on "
           << dealii::Utilities::MPI::n_mpi_processes(communicator)
           << " rank(s). Effects:\n";
      text << Output::effects_as_text(effects_of(scene));
      log << text.str();
    }

    const LoopReport report = loop.run();
    loop.get_recorder().finish(report);
    log.print_wall_times();
    end_run(report,
            loop.get_system().time(),
            "the results so far are in '" + options.output_directory + "'." +
                checkpoints.advice());
  }


  Prediction
  predict_run(const Scene::Scene &scene)
  {
    if (scene.plate_bodies.empty())
      return predict_experiment(scene);
    RunLog       log("", true, false);
    Bite         bite(scene, MPI_COMM_WORLD, log);
    const Course course = expected_course(scene, bite.closing_axis());
    const double end = scene.time.end_time, dt = bite.time_step();
    const double steps = std::ceil(course.time_of(course.closure, end) / dt);
    const double sound =
        std::min(steps, std::ceil(course.time_of(course.failure, end) / dt));

    Prediction prediction;
    prediction.scene   = scene.name;
    prediction.effects = Output::effects_as_text(effects_of(scene));
    prediction.advice  = scene.warnings;
    prediction.counts.emplace_back("Time step", number_text(dt) + " s");
    prediction.count("Particles", bite.particle_count());
    prediction.counts.emplace_back(
        "Cells",
        std::to_string(bite.food().get_host().n_cells()) +
            " (background mesh)");
    prediction.counts.emplace_back("Steps",
                                   "about " + number_text(steps) +
                                       " of at most " +
                                       number_text(std::ceil(end / dt)));
    prediction.unknowns = 2. * bite.particle_count();
    prediction.steps    = steps;
    predict_steps(prediction,
                  scene,
                  bite.particle_count(),
                  trial_step_time(bite, sound),
                  sound +
                      (steps - sound) * Costs().figure("step after failure"));
    return prediction;
  }
} // namespace Morsel
