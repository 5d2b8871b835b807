#ifndef morsel_core_particle_edges_h
#define morsel_core_particle_edges_h

#include <algorithm>
#include <vector>

namespace Morsel
{
  /// Where the edge of a body lies, seen from one of its particles.
  struct ParticleEdge
  {
    double distance; ///< [m]
    double width;    ///< of edge that the particle stands for [m]
  };


  /// The same of each of the particles that a rank knows. Empty for a lattice:
  /// half a spacing away and one spacing wide for all.
  struct ParticleEdges
  {
    std::vector<ParticleEdge> of_particle;
    /// No particle of the whole body has larger ones, whoever owns it: what
    /// all ranks have to choose alike follows from these.
    ParticleEdge largest{0., 0.};

    /// Not whether this rank has particles.
    bool
    empty() const
    {
      return largest.width == 0.;
    }

    /// Takes a particle of the body into account, known to this rank or not.
    void
    enlarge(const ParticleEdge &edge)
    {
      largest.distance = std::max(largest.distance, edge.distance);
      largest.width    = std::max(largest.width, edge.width);
    }
  };
} // namespace Morsel

#endif
