#ifndef morsel_core_data_files_h
#define morsel_core_data_files_h

#include <string>
#include <vector>

namespace Morsel
{
  /// The path of a file that ships with the program: in its source tree's
  /// folder "data", in share/morsel, or beside the program.
  /// @param name relative to that folder, "materials.json"
  /// @throw FileError if it is in none of them
  std::string
  shipped_file(const std::string &name);


  /// The paths of all files of a shipped folder whose names end in ".json",
  /// in the order of their names.
  /// @throw FileError if the folder is missing
  std::vector<std::string>
  shipped_json_files(const std::string &folder);
} // namespace Morsel

#endif
