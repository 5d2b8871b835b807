#ifndef morsel_core_run_options_h
#define morsel_core_run_options_h

#include <string>

namespace Morsel
{
  /// How a scene is run, as opposed to what it is about.
  struct RunOptions
  {
    std::string  output_directory;      ///< exists and is writable once running
    unsigned int threads       = 1;     ///< per rank
    bool         resume        = false; ///< from the newest good checkpoint
    bool         quiet         = false; ///< nothing on the terminal but errors
    bool         validate_only = false; ///< check the scene, run nothing
  };
} // namespace Morsel

#endif
