#ifndef morsel_study_collection_h
#define morsel_study_collection_h

#include <morsel/core/command_line.h>

#include <string>
#include <vector>

namespace Morsel::Study
{
  /// Whether the file is a collection of studies: it has a section
  /// "Collection".
  bool
  is_collection(const std::string &file_name);


  /// Every parameter of a collection ("prm", "json" or "md").
  std::string
  collection_parameters(const std::string              &format,
                        const std::string              &file_name,
                        const std::vector<std::string> &overrides);


  /// Checks all studies of a collection, then carries them out one after
  /// another in <folder of results>/parts, and keeps collection.json up to
  /// date. A part that fails does not stop the others, and the same command
  /// goes on where it was ended.
  /// @throw InputError for mistakes, before anything is written
  /// @throw NumericalError if no part finished
  /// @throw FileError
  /// @throw Interrupted with what has finished being kept
  void
  run_collection(const CommandLine &command_line);
} // namespace Morsel::Study

#endif
