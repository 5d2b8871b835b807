#ifndef morsel_source_run_state_h
#define morsel_source_run_state_h

#include <morsel/sph/host.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// How the particle bodies of a run are shared out among the ranks, body by
  /// body; none where all go by the number of particles.
  using Partition = std::vector<SPH::CellWork>;


  inline SPH::CellWork
  part_of_body(const Partition &partition, const unsigned int body)
  {
    return partition.empty() ? SPH::CellWork() : partition[body];
  }


  /// All of a run between two steps, in memory.
  struct RunState
  {
    Partition          partition;        ///< that it belongs to
    std::string        system, recorder; ///< as their exchange_state() saves
    double             time      = 0.;   ///< [s]
    unsigned long long step      = 0;
    double             time_step = 0.; ///< [s]
  };
} // namespace Morsel

#endif
