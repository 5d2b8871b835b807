#ifndef morsel_particle_plate_run_h
#define morsel_particle_plate_run_h

#include <morsel/core/command_line.h>
#include <morsel/sph/plate_problem.h>

#include <string>

namespace Morsel
{
  /// Checks and runs a cracked plate by particles ("set Method = SPH"), on
  /// one rank. Leaves summary.json, used.prm, run.log, stress_intensity.csv
  /// (K per ring) and solution/particles.vtu in the folder of results.
  /// @param plate     its name is set
  /// @param used      all parameters as a file
  /// @throws InputError, NumericalError, FileError
  void
  run_particle_plate(const CommandLine          &command_line,
                     const SPH::PlateParameters &plate,
                     const std::string          &used);
} // namespace Morsel

#endif
