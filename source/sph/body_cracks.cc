#include <morsel/fracture/crack_paths.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/visibility.h>

namespace Morsel::SPH
{
  using dealii::Point;

  std::vector<Fracture::Crack>
  cracks_of(const Scene::ParticleBody &body)
  {
    if (body.cracks.paths.empty())
      return {};
    const std::string    entry   = "Body " + body.name + "/Cracks/Paths";
    const Scene::Outline outline = body.shape.outline();
    const auto           depth   = [&](const Point<2> &p) {
      return (outline.contains(p) ? 1. : -1.) * outline.distance(p);
    };
    return Fracture::cracks_in(
        {"body '" + body.name + "'", outline.lower(), outline.upper(), depth},
        Fracture::read_crack_paths(body.cracks.paths, entry),
        entry);
  }


  std::vector<Fracture::Crack>
  barriers_of(const Scene::ParticleBody   &body,
              const std::vector<Point<2>> &points)
  {
    std::vector<Fracture::Crack> barriers = cracks_of(body);
    check_off_cracks(points,
                     barriers,
                     body.spacing,
                     "choose numbers of particles that put no row of body '" +
                         body.name +
                         "' there (even ones for a crack at mid height).");
    const Scene::Outline outline = body.shape.outline();
    if (!outline.is_convex())
      for (const Scene::Outline::Edge &edge : outline.get_edges())
        barriers.emplace_back(
            std::vector<Point<2>>{edge.first, edge.second}, false, false);
    return barriers;
  }
} // namespace Morsel::SPH
