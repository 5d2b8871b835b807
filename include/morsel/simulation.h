#ifndef morsel_simulation_h
#define morsel_simulation_h

#include <morsel/core/run_options.h>
#include <morsel/prediction.h>
#include <morsel/scene/scene.h>

namespace Morsel
{
  /// Runs a scene and leaves its results in the output folder; collective
  /// over all ranks.
  /// @throws InputError, NumericalError, FileError, Interrupted.
  void
  run_simulation(const Scene::Scene &scene, const RunOptions &options);


  /// What a run of the scene would be; collective.
  Prediction
  predict_run(const Scene::Scene &scene);
} // namespace Morsel

#endif
