#include "run_beginning.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/command_line.h>
#include <morsel/core/failure.h>

namespace Morsel
{
  void
  begin_results(const Scene::Scene &scene,
                const RunOptions   &options,
                Checkpoints        &checkpoints,
                RunLog             &log)
  {
    const FirstRank first;
    first.run([&] {
      prepare_output_directory(options.output_directory);
      log.open(options.output_directory + "/run.log", options.resume);
      write_atomically(options.output_directory + "/used.prm",
                       scene.used_parameters);
    });
    checkpoints.begin(log);
    log << scene.title << '\n';
    for (const auto &advice : scene.warnings)
      log.warning(advice);
  }


  std::string
  scaled_mass_text(const Scene::Scene &scene)
  {
    const double factor = scene.time.inertia_factor;
    return factor == 1. ? "" : ", mass scaled by " + number_text(factor);
  }
} // namespace Morsel
