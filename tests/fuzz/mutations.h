#ifndef morsel_fuzz_mutations_h
#define morsel_fuzz_mutations_h

#include "gallery.h"
#include "random.h"

#include <string>

namespace Fuzz
{
  struct Mutation
  {
    std::string text; ///< of the mutated file
    std::string what; ///< in words, for the report
    /// The text sets an entry, or opens a section, that nothing declares, so
    /// it must be refused.
    bool unknown_name = false;
  };


  /// Changes a scene, study or collection in one to three places.
  /// @param known_keys all declared entries; a mutated key outside of these is
  ///   unknown.
  Mutation
  mutate_scene(const std::string           &text,
               const Gallery               &gallery,
               const std::set<std::string> &known_keys,
               Random                      &random);

  /// Changes a mesh (Gmsh's text or geometry) or a table of numbers.
  Mutation
  mutate_data(const std::string &text, Random &random);

  /// Changes that know nothing of what is in the file: bytes, encodings, line
  /// ends, sizes, truncation. Returns what was done.
  std::string
  mutate_bytes(std::string &text, Random &random);
} // namespace Fuzz

#endif
