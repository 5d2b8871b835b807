#ifndef morsel_scene_read_h
#define morsel_scene_read_h

#include <morsel/calibrate/parameters.h>
#include <morsel/scene/scene.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// Reads and checks a scene file.
  /// @param overrides entries "Section/Sub/Key=value" that go before the
  ///   file's.
  /// @throw InputError with a sentence for every mistake of the user.
  /// @throw FileError if a file is there but cannot be read.
  Scene
  read_scene(const std::string              &file_name,
             const std::vector<std::string> &overrides = {});


  /// The same on all ranks; the first one reads before the others, so that it
  /// alone says what is wrong with a bad scene. Collective.
  Scene
  read_scene_on_all_ranks(const std::string              &file_name,
                          const std::vector<std::string> &overrides);


  /// What --calibrate shall do with a scene: its section "Calibration", which
  /// used_parameters does not hold.
  /// @throw InputError, FileError as read_scene()
  Calibrate::CalibrationParameters
  read_calibration(const std::string              &file_name,
                   const std::vector<std::string> &overrides = {});


  /// How print_parameters() writes.
  enum class ParameterFormat
  {
    prm,
    json,
    markdown
  };


  /// Every parameter with its default, range, unit and meaning, for a scene
  /// with a food and a plate; or, if a scene file is named, for that scene with
  /// its values.
  std::string
  print_parameters(ParameterFormat                 format,
                   const std::string              &file_name = "",
                   const std::vector<std::string> &overrides = {});
} // namespace Morsel::Scene

#endif
