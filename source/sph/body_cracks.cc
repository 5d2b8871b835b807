#include <morsel/fracture/crack_paths.h>
#include <morsel/sph/body_cracks.h>

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


  Visibility
  visibility_in(const Scene::ParticleBody   &body,
                const std::vector<Point<2>> &points,
                const double                 reach)
  {
    const std::vector<Fracture::Crack> cracks = cracks_of(body);
    check_off_cracks(points,
                     cracks,
                     body.spacing,
                     "choose numbers of particles that put no row of body '" +
                         body.name +
                         "' there (even ones for a crack at mid height).");
    return Visibility(
        cracks, TipHandling::visibility, reach, body.shape.outline().walls());
  }
} // namespace Morsel::SPH
