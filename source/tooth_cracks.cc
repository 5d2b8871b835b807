#include "tooth_cracks.h"

#include <morsel/core/errors.h>
#include <morsel/fe/polygon.h>
#include <morsel/fracture/crack_paths.h>

namespace Morsel
{
  namespace
  {
    /// Inside of the mesh's boundary, negative outside [m].
    double
    depth_inside(const dealii::Triangulation<2> &mesh,
                 const dealii::Point<2>         &p)
    {
      bool inside = false;
      for (const auto &cell : mesh.active_cell_iterators())
        inside =
            inside ||
            (p.distance(cell->center()) < cell->diameter() &&
             FE::distance_to_polygon(p, FE::make_map(cell).polygon()) == 0.);
      return (inside ? 1. : -1.) * FE::distance_to_boundary(mesh, p);
    }
  } // namespace


  FE::ElasticBodyCracks
  cracks_of(const Scene::PlateBody &plate, const dealii::Triangulation<2> &mesh)
  {
    FE::ElasticBodyCracks result;
    if (plate.cracks.paths.empty())
      return result;
    const std::string entry = "Body " + plate.name + "/Cracks/Paths";
    const auto paths = Fracture::read_crack_paths(plate.cracks.paths, entry);
    result.cracks    = Fracture::cracks_in(
        {"body '" + plate.name + "'",
            plate.shape.lower_corner,
            plate.shape.upper_corner,
            [&](const dealii::Point<2> &p) { return depth_inside(mesh, p); }},
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
