#ifndef morsel_core_particle_edges_h
#define morsel_core_particle_edges_h

#include <vector>

namespace Morsel
{
  /// Where the edge of a body lies, seen from each of its particles. Empty
  /// for a lattice: half a spacing away and one spacing wide for all.
  struct ParticleEdges
  {
    std::vector<double> distance; ///< [m]
    std::vector<double> width;    ///< of edge that the particle stands for [m]
  };
} // namespace Morsel

#endif
