#ifndef morsel_sph_body_cloud_h
#define morsel_sph_body_cloud_h

#include <morsel/scene/scene.h>
#include <morsel/sph/cloud.h>

namespace Morsel::SPH
{
  /// The particles of a body with their cells: the one place where a body of
  /// any shape becomes points.
  ///
  /// A rectangle's lattice is that of ParticleBody::positions(). Of other
  /// shapes a lattice keeps the points that stand at least a quarter of a
  /// spacing inside, less those whose cells stay below 0.4 dp^2. A relaxed
  /// filling begins with rows half a spacing inside of the boundary, between
  /// its corners, and with a lattice between them; Lloyd iterations move all
  /// particles to the centroids of their cells.
  /// @param seed of the random offsets
  /// @throws InputError, one sentence, if the body is thinner than two
  ///   particles somewhere
  Cloud
  body_cloud(const Scene::ParticleBody &body, const unsigned int seed);


  /// How even the cells of a cloud are, in units of their mean area [1].
  struct Evenness
  {
    double smallest = 0., largest = 0., deviation = 0.;
  };

  Evenness
  evenness(const Cloud &cloud);
} // namespace Morsel::SPH

#endif
