#include <morsel/calibrate/calibrate.h>
#include <morsel/calibration.h>
#include <morsel/core/command_line.h>
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/signals.h>
#include <morsel/fracture_run.h>
#include <morsel/plan/plan.h>
#include <morsel/scene/read.h>
#include <morsel/simulation.h>
#include <morsel/study/collection.h>
#include <morsel/study/run_study.h>
#include <morsel/study/study.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  using namespace Morsel;

  /// Whether this process is no rank of an mpirun, whose PMI would have said
  /// so.
  bool
  is_started_alone()
  {
    for (const char *variable :
         {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
      if (std::getenv(variable))
        return false;
    return true;
  }


  /// Whether words are asked for that need no rank to agree on them.
  bool
  asks_for_words_only(const int argc, char **argv)
  {
    if (argc != 2)
      return false;
    const std::string option = argv[1];
    return option == "--version" || option == "--help" || option == "-h";
  }


  Scene::ParameterFormat
  parameter_format(const std::string &name)
  {
    if (name == "json")
      return Scene::ParameterFormat::json;
    return name == "md" ? Scene::ParameterFormat::markdown
                        : Scene::ParameterFormat::prm;
  }


  /// For what is no run in time, and so has no state to go on from.
  void
  begin_solve_at_once(const RunOptions &options)
  {
    if (options.resume)
      throw InputError("--resume: a static scene is solved at once and keeps "
                       "no checkpoint; leave the option out.");
    end_on_signals();
  }


  void
  run(const CommandLine &command_line)
  {
    const bool is_collection = Study::is_collection(command_line.scene_file);
    if (!command_line.plan.empty() &&
        (is_collection || Study::is_study(command_line.scene_file)))
      throw InputError("--plan: '" + command_line.scene_file +
                       "' is a study; give a scene.");
    if (command_line.calibrate)
      {
        Calibrate::run_calibration(command_line);
        return;
      }
    if (is_collection)
      {
        Study::run_collection(command_line);
        return;
      }
    if (Study::is_study(command_line.scene_file))
      {
        Study::run_study(command_line);
        return;
      }
    RunOptions options = command_line.run;
    options.resume     = command_line.resume;
    if (options.threads > 0)
      dealii::MultithreadInfo::set_thread_limit(options.threads);
    options.threads = dealii::MultithreadInfo::n_threads();
    if (!command_line.plan.empty())
      {
        const Plan::Plan plan = Plan::plan_scene(
            command_line.scene_file, command_line.overrides, command_line.plan);
        std::cout << Plan::as_text(
                         plan, command_line.scene_file, command_line.overrides)
                  << std::flush;
        return;
      }
    if (options.validate_only)
      {
        const Prediction prediction =
            predict_scene(command_line.scene_file, command_line.overrides);
        FirstRank().run(
            [&] { std::cout << as_text(prediction) << std::flush; });
        return;
      }
    if (is_fracture_scene(command_line.scene_file, command_line.overrides))
      {
        begin_solve_at_once(options);
        run_fracture_scene(command_line);
        return;
      }
    const Scene::Scene scene = Scene::read_scene_on_all_ranks(
        command_line.scene_file, command_line.overrides);
    if (options.output_directory.empty())
      options.output_directory = "output/" + scene.name;
    if (scene.time.is_static())
      begin_solve_at_once(options);
    else
      catch_signals();
    run_simulation(scene, options);
  }
} // namespace


int
main(int argc, char **argv)
{
  if (is_started_alone())
    {
      if (asks_for_words_only(argc, argv))
        {
          std::cout << read_command_line({argv[1]}).message << std::flush;
          return 0;
        }
      // OpenMPI else starts a daemon, in case this process should want to start
      // others: 0.06 s.
      ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
      // All such processes would share one folder of temporary files, and one
      // that ends takes it from others that begin; one rank needs none.
      ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
      // Nor does it need a network, whose drivers take 0.2 s to be looked for.
      ::setenv("OMPI_MCA_pml", "ob1", 0);
      ::setenv("OMPI_MCA_btl", "self", 0);
      ::setenv("OMPI_MCA_coll", "basic,self,libnbc", 0);
    }

  // What ranks of one machine tell each other in a step is some kilobytes. The
  // messages of a thousand particles at a cut are to be on their way at once,
  // not when both ranks wait for them.
  ::setenv("OMPI_MCA_btl_vader_eager_limit", "32768", 0);

  // Every core of the machine, shared among its ranks, unless told otherwise.
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(
      argc, argv, dealii::numbers::invalid_unsigned_int);

  return exit_status_of([&] {
    start_time();
    const CommandLine command_line =
        read_command_line(std::vector<std::string>(argv + 1, argv + argc));
    FirstRank first_rank;
    if (!command_line.message.empty())
      first_rank.run([&] { std::cout << command_line.message; });
    else if (!command_line.print_parameters.empty() &&
             Study::is_collection(command_line.scene_file))
      first_rank.run([&] {
        std::cout << Study::collection_parameters(command_line.print_parameters,
                                                  command_line.scene_file,
                                                  command_line.overrides);
      });
    else if (!command_line.print_parameters.empty() &&
             Study::is_study(command_line.scene_file))
      first_rank.run([&] {
        std::cout << Study::study_parameters(command_line.print_parameters,
                                             command_line.scene_file,
                                             command_line.overrides);
      });
    else if (!command_line.print_parameters.empty() &&
             is_fracture_scene(command_line.scene_file, command_line.overrides))
      first_rank.run([&] { std::cout << fracture_parameters(command_line); });
    else if (!command_line.print_parameters.empty())
      first_rank.run([&] {
        std::cout << Scene::print_parameters(
            parameter_format(command_line.print_parameters),
            command_line.scene_file,
            command_line.overrides);
        // The pages of reference show both kinds of scenes.
        if (command_line.print_parameters == "md" &&
            command_line.scene_file.empty())
          std::cout << "\n# Cracked plates (Method = XFEM or SPH)\n"
                    << default_fracture_parameters("md");
      });
    else
      run(command_line);
  });
}
