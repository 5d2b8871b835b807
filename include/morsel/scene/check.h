#ifndef morsel_scene_check_h
#define morsel_scene_check_h

#include <morsel/core/parameters.h>
#include <morsel/scene/scene.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// Checks what no single entry shows: whether geometry, material,
  /// resolution, time step, contact and loading go together.
  /// @param entries where the user gave what, for the messages.
  /// @return advice on what is allowed but unwise.
  /// @throw InputError with one line for every mistake found.
  std::vector<std::string>
  check_scene(const Scene                       &scene,
              const std::vector<ParameterEntry> &entries,
              const std::string                 &file_name);
} // namespace Morsel::Scene

#endif
