#ifndef morsel_source_static_run_h
#define morsel_source_static_run_h

#include <morsel/core/run_options.h>
#include <morsel/prediction.h>
#include <morsel/scene/scene.h>

namespace Morsel
{
  /// Finds the static equilibrium of a scene's particle bodies and leaves the
  /// results in the output folder.
  /// @throws InputError, NumericalError, FileError.
  void
  run_static(const Scene::Scene &scene, const RunOptions &options);


  /// What a run of such a scene would be.
  Prediction
  predict_static(const Scene::Scene &scene);
} // namespace Morsel

#endif
