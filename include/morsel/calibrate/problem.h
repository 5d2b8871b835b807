#ifndef morsel_calibrate_problem_h
#define morsel_calibrate_problem_h

#include <morsel/calibrate/parameters.h>
#include <morsel/core/command_line.h>
#include <morsel/materials/parameters.h>

#include <string>
#include <vector>

namespace Morsel::Calibrate
{
  /// A strength to reach, and the scene that measures it.
  struct Target
  {
    std::string              name;   ///< "compressive strength"
    double                   value;  ///< [Pa]
    std::string              scene;  ///< file
    std::string              body;   ///< whose damage is calibrated
    std::string              result; ///< formula of results [Pa]
    std::vector<std::string> overrides;
  };


  /// What a calibration is about, constant once read.
  struct Problem
  {
    std::string                   file; ///< of the scene
    std::string                   name; ///< of the scene
    CalibrationParameters         parameters;
    std::string                   body;
    unsigned int                  particles_across = 0;
    unsigned int                  first_seed       = 1;
    Materials::MaterialParameters material;
    Materials::DamageParameters   damage; ///< as the scene has it
    /// The compressive strength and, where it is asked for, the tensile one.
    std::vector<Target> targets;
  };


  /// Reads and checks the scene, and that which measures the tensile strength.
  /// @throw InputError with a sentence for what cannot be calibrated
  Problem
  read_problem(const CommandLine &command_line);
} // namespace Morsel::Calibrate

#endif
