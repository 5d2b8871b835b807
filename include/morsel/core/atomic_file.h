#ifndef morsel_core_atomic_file_h
#define morsel_core_atomic_file_h

#include <string>

namespace Morsel
{
  /// Creates the folder and its parents where they are missing.
  ///
  /// @throws FileError with the folder's name and the system's reason.
  void
  create_folder(const std::string &folder);


  /// Writes the file so that a reader, or a run killed at any moment, finds
  /// either the old file or the complete new one: temporary file beside it,
  /// fsync, rename.
  ///
  /// @throws FileError with the file's name and the system's reason.
  void
  write_atomically(const std::string &file_name, const std::string &content);
} // namespace Morsel

#endif
