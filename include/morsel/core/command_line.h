#ifndef morsel_core_command_line_h
#define morsel_core_command_line_h

#include <morsel/core/run_options.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// What the user asked for on the command line.
  struct CommandLine
  {
    std::string              scene_file;
    std::vector<std::string> overrides;        ///< of --set
    std::string              print_parameters; ///< prm, json, md or empty
    std::string              plan;             ///< accuracy, or empty
    bool                     calibrate = false;
    bool                     resume    = false;
    /// output_directory is empty if not given, threads 0.
    RunOptions run;

    /// Not empty if there is nothing to do but to print this (--help,
    /// --version).
    std::string message;
  };


  /// Reads the program's arguments, without the program's name.
  /// @throw InputError if an option is unknown or incomplete.
  CommandLine
  read_command_line(const std::vector<std::string> &arguments);


  /// Creates the folder of results if it is missing and tries to write in it.
  /// @throw FileError if that is impossible.
  void
  prepare_output_directory(const std::string &directory);
} // namespace Morsel

#endif
