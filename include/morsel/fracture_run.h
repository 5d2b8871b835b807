#ifndef morsel_fracture_run_h
#define morsel_fracture_run_h

#include <morsel/core/command_line.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// Whether the scene file asks for a cracked plate by finite elements
  /// ("set Method = XFEM") rather than for a chewing stroke.
  bool
  is_fracture_scene(const std::string              &scene_file,
                    const std::vector<std::string> &overrides);


  /// Every parameter of such a scene as a parameter file, JSON or Markdown
  /// ("prm", "json", "md").
  std::string
  fracture_parameters(const CommandLine &command_line);


  /// The same with the default values, without any scene.
  /// @param format prm, json or md
  std::string
  default_fracture_parameters(const std::string &format);


  /// Reads, checks and runs such a scene, or says what a run would do;
  /// collective over all ranks. Leaves summary.json, used.prm, run.log,
  /// stress_intensity.csv (K per ring), crack_opening.csv, tip_stress.csv and
  /// solution/*.{pvd,vtu} in the folder of results.
  /// @throws InputError, NumericalError, FileError
  void
  run_fracture_scene(const CommandLine &command_line);
} // namespace Morsel

#endif
