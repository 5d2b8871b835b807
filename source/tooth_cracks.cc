#include "tooth_cracks.h"

#include <morsel/core/errors.h>
#include <morsel/fracture/crack_paths.h>

namespace Morsel
{
  FE::ElasticBodyCracks
  cracks_of(const Scene::PlateBody &plate)
  {
    FE::ElasticBodyCracks result;
    if (plate.cracks.paths.empty())
      return result;
    const std::string    entry   = "Body " + plate.name + "/Cracks/Paths";
    const Scene::Outline outline = plate.shape.outline();
    const auto           depth   = [&](const dealii::Point<2> &p) {
      return (outline.contains(p) ? 1. : -1.) * outline.distance(p);
    };
    const auto paths = Fracture::read_crack_paths(plate.cracks.paths, entry);
    result.cracks    = Fracture::cracks_in(
        {"body '" + plate.name + "'", outline.lower(), outline.upper(), depth},
        paths,
        entry);
    for (unsigned int c = 0; c < paths.size(); ++c)
      if (result.cracks[c].tips().empty())
        throw InputError("'" + entry + "': the crack from " +
                         Fracture::point_text(paths[c].front()) + " to " +
                         Fracture::point_text(paths[c].back()) +
                         " cuts the body in two; one of its ends must lie "
                         "inside.");
    result.ring_radius = plate.cracks.ring_radius;
    return result;
  }
} // namespace Morsel
