#ifndef morsel_particle_plate_run_h
#define morsel_particle_plate_run_h

#include <morsel/core/run_options.h>
#include <morsel/prediction.h>
#include <morsel/sph/plate_problem.h>

#include <string>

namespace Morsel
{
  /// What a run would be.
  Prediction
  predict_particle_plate(const SPH::PlateParameters &plate);


  /// Solves a cracked plate by particles ("set Method = SPH") and leaves
  /// summary, log, tables and ParaView files in the folder of results.
  /// @param options the folder is made if need be
  /// @param used_parameters as text, for used.prm
  /// @throws InputError on several ranks
  void
  run_particle_plate(const SPH::PlateParameters &plate,
                     const RunOptions           &options,
                     const std::string          &used_parameters);
} // namespace Morsel

#endif
