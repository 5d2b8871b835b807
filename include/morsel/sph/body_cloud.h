#ifndef morsel_sph_body_cloud_h
#define morsel_sph_body_cloud_h

#include <morsel/scene/scene.h>
#include <morsel/sph/cloud.h>

namespace Morsel::SPH
{
  /// The particles of a body with their Voronoi cells: the one place where a
  /// body of a scene becomes points with volumes.
  Cloud
  body_cloud(const Scene::ParticleBody &body, unsigned int seed);
} // namespace Morsel::SPH

#endif
