#ifndef morsel_scene_mass_scaling_h
#define morsel_scene_mass_scaling_h

#include <morsel/scene/scene.h>

namespace Morsel::Scene
{
  /// The density that the inertia of particles sees over their material's [1].
  ///
  /// With forces that know no rate, a density M times as large is a plate
  /// sqrt(M) times as fast in a time that runs as much faster: only the ratio
  /// of kinetic to strain energy changes, by M. Where 'Time/Mass scaling' is 0,
  /// M is the largest at least 1 with which this ratio stays below
  /// 'Time/Kinetic share' when the food fails: between a plate at rest and one
  /// of speed v, or two that approach each other with v each, the mean kinetic
  /// energy density is M rho v^2/6, that of strain at the stress sigma is
  /// sigma^2/(2 E').
  ///
  /// 1 where the scene does not say enough for that; check_mass_scaling()
  /// refuses it.
  double
  inertia_factor(const Scene &scene);
} // namespace Morsel::Scene

#endif
