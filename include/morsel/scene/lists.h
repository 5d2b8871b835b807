#ifndef morsel_scene_lists_h
#define morsel_scene_lists_h

#include <morsel/core/parameters.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  struct NamedBody
  {
    std::string name;
    std::string kind;
  };


  /// What a scene names: first of the two passes over its entries, since
  /// the second has to know which sections there are.
  struct NamedParts
  {
    std::vector<NamedBody>   bodies;
    std::vector<std::string> conditions;
    std::vector<std::string> observers;
    std::vector<std::string> muscles;
  };


  /// @throws InputError for a scene without bodies, a bad or repeated name, an
  ///   unknown kind, and a section of something that is not listed.
  NamedParts
  list_parts(const std::string                 &file_name,
             const std::vector<ParameterEntry> &entries);
} // namespace Morsel::Scene

#endif
