#ifndef morsel_sph_body_cracks_h
#define morsel_sph_body_cracks_h

#include <morsel/fracture/crack.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/visibility.h>

#include <vector>

namespace Morsel::SPH
{
  /// The cracks that the scene gives to a body.
  /// @throws InputError, see Fracture::cracks_in()
  std::vector<Fracture::Crack>
  cracks_of(const Scene::ParticleBody &body);


  /// Who sees whom in a body with its cracks, in its reference configuration.
  /// @param points the particles [m]
  /// @param reach  support radius of the kernel [m]
  /// @throws InputError, see cracks_of(), and for a particle on a crack
  Visibility
  visibility_in(const Scene::ParticleBody           &body,
                const std::vector<dealii::Point<2>> &points,
                const double                         reach);
} // namespace Morsel::SPH

#endif
