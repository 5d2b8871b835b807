#ifndef morsel_source_experiment_run_h
#define morsel_source_experiment_run_h

#include <morsel/core/run_options.h>
#include <morsel/prediction.h>
#include <morsel/scene/scene.h>

namespace Morsel
{
  /// Runs a scene without plates and leaves its results in the output folder.
  /// @throws InputError, NumericalError, FileError, Interrupted.
  void
  run_experiment(const Scene::Scene &scene, const RunOptions &options);


  /// What a run of such a scene would be.
  Prediction
  predict_experiment(const Scene::Scene &scene);
} // namespace Morsel

#endif
