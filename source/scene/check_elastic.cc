#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>
#include <morsel/scene/mesh.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Morsel::Scene
{
  namespace
  {
    /// More cells than this on one side are a mistake in the unit.
    constexpr double most_cells = 2000.;


    void
    check_held_sides(const PlateBody                &body,
                     const std::vector<std::string> &held,
                     Findings                       &findings)
    {
      std::vector<std::string> sides = {"left", "right", "bottom", "top"};
      const std::string       &file  = body.shape.mesh_file;
      if (!file.empty())
        {
          sides.clear();
          for (const auto &side : sides_of_mesh(file))
            sides.push_back(side.first);
          dealii::Triangulation<2> mesh;
          read_mesh(file, mesh);
          if (!mesh.all_reference_cells_are_hyper_cube())
            findings.mistake("Body " + body.name + "/Shape/Mesh file",
                             "the mesh has triangles; an elastic body is made "
                             "of quadrilaterals, in Gmsh by 'Recombine "
                             "Surface'.");
        }
      const std::string path = "Body " + body.name + "/Deformation/Held sides";
      for (const std::string &name : held)
        if (std::find(sides.begin(), sides.end(), name) == sides.end())
          findings.mistake(path,
                           "there is no side '" + name + "', only " +
                               quoted_list(sides) + "." +
                               did_you_mean(name, sides));
    }


    void
    check_support(const PlateBody                &body,
                  const std::vector<std::string> &held,
                  const Scene                    &scene,
                  Findings                       &findings)
    {
      const auto       &given   = body.deformation;
      const std::string section = "Body " + body.name + "/Deformation/";
      if (held.empty() && given.response != "auto" &&
          given.response != "dynamic")
        findings.mistake(section + "Response",
                         "nothing holds the body, so that only its inertia "
                         "can answer the food: name 'Held sides', or take "
                         "'dynamic'.");
      if (held.empty() &&
          (body.motion.kind != "constant" || body.motion.velocity.norm() > 0.))
        findings.mistake(
            "Body " + body.name + "/Motion/" +
                (body.motion.kind == "constant" ? "Velocity" : "Kind"),
            "a body that nothing holds does not follow a motion: "
            "name '" +
                section + "Held sides', or give 'Initial velocity' there.");
      if (!held.empty() && given.initial_velocity.norm() > 0.)
        findings.mistake(section + "Initial velocity",
                         "the body is held and begins with the velocity of "
                         "its motion; leave this out.");
      if (given.response == "quasi-static" &&
          scene.contact.law != "gap penalty")
        findings.mistake(section + "Response",
                         "a body without inertia needs 'Contact/Law' = 'gap "
                         "penalty'; or take 'dynamic'.");
    }
  } // namespace


  void
  check_elastic(const PlateBody &body, const Scene &scene, Findings &findings)
  {
    const auto       &given    = body.deformation;
    const std::string material = "Body " + body.name + "/Material/";
    if (!(given.density > 0.))
      findings.mistake(material + "Density",
                       "the density must be positive, in kg/m^3.");
    if (!(given.youngs_modulus > 0.))
      findings.mistake(material + "Young's modulus",
                       "Young's modulus must be positive, in Pa.");

    if (given.beta > 0. && given.beta < 0.25)
      findings.mistake("Body " + body.name + "/Deformation/Newmark beta",
                       "below 0.25 the body's own waves limit the step; give "
                       "0.25 to 1, or 0 for what suits the contact.");

    const auto held =
        dealii::Utilities::split_string_list(given.held_sides, ',');
    check_held_sides(body, held, findings);
    check_support(body, held, scene, findings);
    check_tooth_cracks(body, findings);

    const std::string path = "Body " + body.name + "/Deformation/Cell size";
    const double      size = given.cell_size;
    if (size > 0. && !body.shape.is_mesh())
      for (unsigned int d = 0; d < 2; ++d)
        if (body.shape.extent(d) > most_cells * size)
          {
            findings.mistake(path,
                             "it makes more than " + number_text(most_cells) +
                                 " cells along " + std::string(1, "xy"[d]) +
                                 "; lengths are in metres, 1 mm is 0.001.");
            break;
          }
  }
} // namespace Morsel::Scene
