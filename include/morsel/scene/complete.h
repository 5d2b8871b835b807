#ifndef morsel_scene_complete_h
#define morsel_scene_complete_h

#include <morsel/core/parameters.h>
#include <morsel/scene/scene.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// Closure along an axis at which a body that can fail is expected to [m]:
  /// its extent times strength over plane-strain modulus.
  double
  expected_failure_closure(const ParticleBody &body, unsigned int axis);

  /// What follows from the entries: names, spacings, materials, pairs.
  /// @param pairs the text of Contact/Pairs.
  /// @throws InputError for an unknown material or body.
  void
  complete_scene(Scene                             &scene,
                 const std::string                 &pairs,
                 const std::string                 &file_name,
                 const std::vector<ParameterEntry> &entries);
} // namespace Morsel::Scene

#endif
