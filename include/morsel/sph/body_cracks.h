#ifndef morsel_sph_body_cracks_h
#define morsel_sph_body_cracks_h

#include <morsel/fracture/crack.h>
#include <morsel/scene/scene.h>

#include <vector>

namespace Morsel::SPH
{
  /// The cracks that the scene gives to a body.
  /// @throws InputError, see Fracture::cracks_in()
  std::vector<Fracture::Crack>
  cracks_of(const Scene::ParticleBody &body);


  /// What hides particles of a body from each other: its cracks, and its
  /// boundary if straight lines between particles can leave it.
  /// @param points the particles [m]
  /// @throws InputError, see cracks_of(), and for a particle on a crack
  std::vector<Fracture::Crack>
  barriers_of(const Scene::ParticleBody           &body,
              const std::vector<dealii::Point<2>> &points);
} // namespace Morsel::SPH

#endif
