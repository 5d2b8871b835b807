#ifndef morsel_fuzz_gallery_h
#define morsel_fuzz_gallery_h

#include <set>
#include <string>
#include <vector>

namespace Fuzz
{
  /// A file of the gallery that is mutated, and the scene that is started:
  /// the file itself, or one that names it.
  struct Target
  {
    std::string scene, file;
  };


  /// What the mutations draw from: scenes, studies and collections with the
  /// meshes and tables that they name. All paths are relative to the source
  /// tree.
  struct Gallery
  {
    /// @param root source tree with prm/ and meshes/.
    /// @throw std::runtime_error if there is no gallery.
    explicit Gallery(const std::string &root);

    std::vector<std::string> files;        ///< all, for the copy
    std::vector<Target>      scenes;       ///< each scene by itself
    std::vector<Target>      dependencies; ///< a file that a scene names
    std::vector<std::string> values;       ///< right sides of all entries
    std::vector<std::string> blocks;       ///< entries and whole subsections
    std::set<std::string>    keys; ///< of all entries that the gallery sets
  };


  /// @throw std::runtime_error if the file cannot be read.
  std::string
  read_file(const std::string &path);

  std::vector<std::string>
  split_lines(const std::string &text);

  /// The key of "  set key = value", empty if the line is something else.
  std::string
  key_of(const std::string &line);

  /// Keys that a text of parameters (--print-parameters prm) sets.
  std::set<std::string>
  keys_of(const std::string &text);

  /// Fewer particles, cells, steps and runs, so that a run takes seconds
  /// and its validation, which tries a few steps, a fraction of one.
  std::string
  shrunk(const std::string &scene);
} // namespace Fuzz

#endif
