#ifndef morsel_scene_complete_h
#define morsel_scene_complete_h

#include <morsel/core/parameters.h>
#include <morsel/scene/scene.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
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
