#ifndef morsel_scene_write_back_h
#define morsel_scene_write_back_h

#include <morsel/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

namespace Morsel::Scene
{
  /// Writes what was derived (from the catalogue, from meshes, from each other)
  /// back, so that the printed parameters reproduce the run.
  /// @param scene is bound to @p prm: setting an entry sets its member, too
  void
  write_back(const Scene &scene, dealii::ParameterHandler &prm);
} // namespace Morsel::Scene

#endif
