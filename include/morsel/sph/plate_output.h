#ifndef morsel_sph_plate_output_h
#define morsel_sph_plate_output_h

#include <morsel/sph/plate_problem.h>

#include <string>

namespace Morsel::SPH
{
  /// The particles of a body in equilibrium as points of a ParaView file (vtu)
  /// with displacement [m], stress and von Mises stress [Pa] and volume per
  /// metre of depth [m^2].
  std::string
  particles_vtu(const Equilibrium &body);


  /// The particles' Voronoi cells as polygons of a ParaView file. Each has
  /// points of its own, at which the fields are those that its particle sees:
  /// displaced by them, the crack is really open.
  std::string
  cells_vtu(const Equilibrium &body);


  /// The same of a cracked plate, with the distance to the nearest tip in
  /// units of its largest ring.
  std::string
  cells_vtu(const PlateProblem &problem);
} // namespace Morsel::SPH

#endif
