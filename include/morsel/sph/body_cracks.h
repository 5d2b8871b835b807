#ifndef morsel_sph_body_cracks_h
#define morsel_sph_body_cracks_h

#include <morsel/fracture/crack.h>
#include <morsel/scene/scene.h>

#include <vector>

namespace Morsel::SPH
{
  /// The cracks that the scene gives to a body, off its particles.
  /// @param seed of the scene, for scattered particles
  /// @throws InputError, see Fracture::cracks_in(), and for a particle on a
  ///   crack
  std::vector<Fracture::Crack>
  cracks_of(const Scene::ParticleBody &body, const unsigned int seed);
} // namespace Morsel::SPH

#endif
