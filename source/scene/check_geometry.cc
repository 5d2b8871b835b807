#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace Morsel::Scene
{
  namespace
  {
    /// What another kind of shape would take. Printed parameters give every
    /// entry, so that what is left at its default says nothing.
    void
    check_shape_entries(const ParticleBody &body, Findings &findings)
    {
      const BodyShape &shape = body.shape;
      const struct
      {
        std::string key, kind;
        bool        given;
      } entries[] = {{"Loops", "polygon", !shape.loops.empty()},
                     {"Side names", "polygon", !shape.side_names.empty()},
                     {"Outer radius", "annulus", shape.outer_radius > 0.},
                     {"Mesh file", "mesh", !shape.mesh_file.empty()}};
      for (const auto &entry : entries)
        if (entry.given && entry.kind != shape.kind)
          findings.mistake("Body " + body.name + "/Shape/" + entry.key,
                           "it belongs to the kind '" + entry.kind +
                               "', but the shape's 'Kind' is '" + shape.kind +
                               "'; leave it out, or change the kind.");
    }


    void
    check_shape_entries(const PlateBody &body, Findings &findings)
    {
      const PlateShape &shape = body.shape;
      if (shape.is_mesh())
        return;
      for (const auto &[key, given] :
           {std::pair("Mesh angle", shape.mesh_angle != 0.),
            std::pair("Mesh shift", shape.mesh_shift.norm() > 0.)})
        if (given)
          findings.mistake("Body " + body.name + "/Shape/" + key,
                           "it moves a mesh, but the body is a rectangle; "
                           "name its 'Mesh file', or leave this out.");
    }


    /// A body of whatever kind.
    struct Solid
    {
      std::string              name;
      const Rectangle         *shape;
      bool                     rigid, rectangle;
      std::string              end_entry; ///< that says where it ends
      std::string              place_entry;
      std::function<Outline()> outline;
    };


    void
    check_apart(const Solid &solid,
                const Solid &other,
                const double tolerance,
                Findings    &findings)
    {
      double      common = overlap(*solid.shape, *other.shape);
      std::string place;
      if (common > tolerance && !(solid.rectangle && other.rectangle))
        {
          const Separation s = separation(solid.outline(), other.outline());
          common             = -s.gap;
          place              = " at (" + number_text(s.where[0]) + ", " +
                  number_text(s.where[1]) + ") m";
        }
      if (common <= tolerance)
        return;
      const std::string text = "the body overlaps '" + other.name + "' by " +
                               number_text(common) + " m" + place;
      const std::string path =
          "Body " + solid.name + "/Shape/" + solid.place_entry;
      if (solid.rigid && other.rigid)
        findings.advise(path, text + ".");
      else
        findings.mistake(path, text + "; move one of them.");
    }


    /// A side shorter than this share of the other has no length for what is
    /// done with outlines.
    constexpr double least_side = 1e-8;


    void
    check_rectangle(const Rectangle   &shape,
                    const std::string &section,
                    const std::string &entry,
                    Findings          &findings)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          if (!(shape.extent(d) > 0.))
            {
              findings.mistake(section + "/" + entry,
                               std::string("it must lie above the lower corner "
                                           "in ") +
                                   "xy"[d] + " (lower " +
                                   number_text(shape.lower_corner[d]) +
                                   ", upper " +
                                   number_text(shape.upper_corner[d]) + ").");
              return;
            }
          if (shape.extent(d) > 10.)
            findings.advise(section + "/" + entry,
                            "the size is " + number_text(shape.extent(d)) +
                                " m; lengths are in metres, 10 mm are 0.01.");
        }
      const auto [less, more] = std::minmax({shape.extent(0), shape.extent(1)});
      if (!(less > least_side * more))
        findings.mistake(section + "/" + entry,
                         "the sides, " + number_text(shape.extent(0)) +
                             " m and " + number_text(shape.extent(1)) +
                             " m, are too different: one may be " +
                             number_text(1. / least_side) +
                             " times as long as the other.");
    }


    void
    check_inside_domain(const Rectangle   &shape,
                        const std::string &name,
                        const Rectangle   &domain,
                        Findings          &findings)
    {
      for (unsigned int d = 0; d < 2; ++d)
        for (const bool upper : {false, true})
          {
            const double body_end =
                upper ? shape.upper_corner[d] : shape.lower_corner[d];
            const double domain_end =
                upper ? domain.upper_corner[d] : domain.lower_corner[d];
            const double beyond =
                upper ? body_end - domain_end : domain_end - body_end;
            if (beyond > 1e-9 * std::abs(domain.extent(d)))
              {
                const std::string corner =
                    upper ? "/Shape/Upper corner" : "/Shape/Lower corner";
                findings.mistake(
                    "Body " + name + corner,
                    "the body lies outside of the domain, which ends at " +
                        std::string(1, "xy"[d]) + " = " +
                        number_text(domain_end) +
                        " m; move the body or enlarge the domain.");
              }
          }
    }
  } // namespace


  double
  overlap(const Rectangle &a, const Rectangle &b)
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (unsigned int d = 0; d < 2; ++d)
      smallest = std::min(smallest,
                          std::min(a.upper_corner[d], b.upper_corner[d]) -
                              std::max(a.lower_corner[d], b.lower_corner[d]));
    return smallest;
  }


  double
  gap_between(const ParticleBody &food, const PlateBody &plate)
  {
    return food.shape.is_rectangle() && !plate.shape.is_mesh()
               ? -overlap(food.shape, plate.shape)
               : separation(food.shape.outline(), plate.shape.outline()).gap;
  }


  void
  check_geometry(const Scene &scene, Findings &findings)
  {
    std::vector<Solid> solids;
    for (const ParticleBody &body : scene.particle_bodies)
      {
        check_shape_entries(body, findings);
        solids.push_back({body.name,
                          &body.shape,
                          false,
                          body.shape.is_rectangle(),
                          body.shape.main_entry(),
                          "Lower corner",
                          [&body] { return body.shape.outline(); }});
      }
    for (const PlateBody &body : scene.plate_bodies)
      {
        check_shape_entries(body, findings);
        solids.push_back({body.name,
                          &body.shape,
                          true,
                          !body.shape.is_mesh(),
                          "Upper corner",
                          body.shape.is_mesh() ? "Mesh shift" : "Lower corner",
                          [&body] { return body.shape.outline(); }});
      }

    check_rectangle(scene.domain, "Domain", "Upper corner", findings);
    for (const Solid &solid : solids)
      check_rectangle(*solid.shape,
                      "Body " + solid.name + "/Shape",
                      solid.end_entry,
                      findings);
    if (!findings.clean())
      return;

    for (std::size_t i = 0; i < solids.size(); ++i)
      {
        check_inside_domain(
            *solids[i].shape, solids[i].name, scene.domain, findings);
        // Bodies in static equilibrium know nothing of each other.
        for (std::size_t j = 0; j < (scene.time.is_static() ? 0 : i); ++j)
          check_apart(
              solids[i], solids[j], 1e-9 * scene.domain.extent(0), findings);
      }
    if (!(scene.depth > 0.))
      findings.mistake("Depth", "it must be positive, in m.");
    else if (scene.depth > 1.)
      findings.advise("Depth",
                      "it is in metres; 10 mm are 0.01, and 1 gives "
                      "results per metre.");
  }
} // namespace Morsel::Scene
