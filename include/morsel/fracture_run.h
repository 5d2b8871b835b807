#ifndef morsel_fracture_run_h
#define morsel_fracture_run_h

#include <morsel/core/command_line.h>
#include <morsel/fracture/plate_scene.h>
#include <morsel/prediction.h>

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


  /// The plate of such a scene, whatever method shall compute it.
  /// @throws InputError
  Fracture::PlateScene
  read_plate_scene(const std::string              &scene_file,
                   const std::vector<std::string> &overrides);


  /// What a run of such a scene would be; on one rank.
  /// @throws InputError
  Prediction
  predict_fracture_scene(const std::string              &scene_file,
                         const std::vector<std::string> &overrides);


  /// Reads, checks and runs such a scene; collective over all ranks. Leaves
  /// summary.json, used.prm, run.log, stress_intensity.csv (K per ring),
  /// crack_opening.csv, tip_stress.csv and solution/*.{pvd,vtu} in the folder
  /// of results.
  /// @throws InputError, NumericalError, FileError
  void
  run_fracture_scene(const CommandLine &command_line);
} // namespace Morsel

#endif
