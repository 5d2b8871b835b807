#ifndef morsel_xfem_run_h
#define morsel_xfem_run_h

#include <morsel/core/run_options.h>
#include <morsel/fe/plate_problem.h>

#include <string>

namespace Morsel
{
  /// Solves a cracked plate by extended finite elements and leaves summary,
  /// log, tables and ParaView files in the folder of results; collective over
  /// all ranks.
  /// @param options the folder exists
  /// @param used_parameters as text, for used.prm
  void
  run_xfem(const FE::PlateParameters &plate,
           const RunOptions          &options,
           const std::string         &used_parameters);
} // namespace Morsel

#endif
