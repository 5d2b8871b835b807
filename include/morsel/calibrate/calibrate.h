#ifndef morsel_calibrate_calibrate_h
#define morsel_calibrate_calibrate_h

#include <morsel/core/command_line.h>

namespace Morsel::Calibrate
{
  /// Finds the damage parameters that give a scene's solid its prescribed
  /// strengths: Damage/Threshold factor for the compressive strength, and
  /// Damage/Strength ratio for the tensile one where that is asked for.
  /// Leaves calibration.json and run.log in the folder of results, and tells
  /// what to write into a scene or into the catalogue.
  ///
  /// Runs are processes of their own, so this is for one rank. Finished runs
  /// are kept, and the same command goes on where it was ended.
  /// @throw InputError before anything is written, but for results that the
  ///   first runs turn out not to give
  /// @throw NumericalError if a run failed, if nothing breaks, or if the
  ///   target is not reached
  /// @throw FileError
  /// @throw Interrupted with what has finished being kept
  void
  run_calibration(const CommandLine &command_line);
} // namespace Morsel::Calibrate

#endif
