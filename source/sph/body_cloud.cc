#include <morsel/sph/body_cloud.h>

namespace Morsel::SPH
{
  Cloud
  body_cloud(const Scene::ParticleBody &body, const unsigned int seed)
  {
    Cloud cloud;
    cloud.lower   = body.shape.lower_corner;
    cloud.upper   = body.shape.upper_corner;
    cloud.spacing = body.spacing;
    cloud.points  = body.positions(seed);
    cloud.cells =
        voronoi_cells(cloud.points, cloud.lower, cloud.upper, cloud.spacing);
    return cloud;
  }
} // namespace Morsel::SPH
