#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel::Scene
{
  namespace
  {
    void
    check_rectangle(const Rectangle   &shape,
                    const std::string &section,
                    Findings          &findings)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          if (!(shape.extent(d) > 0.))
            {
              findings.mistake(section + "/Upper corner",
                               std::string("it must lie above the lower corner "
                                           "in ") +
                                   "xy"[d] + " (lower " +
                                   number_text(shape.lower_corner[d]) +
                                   ", upper " +
                                   number_text(shape.upper_corner[d]) + ").");
              return;
            }
          if (shape.extent(d) > 10.)
            findings.advise(section + "/Upper corner",
                            "the size is " + number_text(shape.extent(d)) +
                                " m; lengths are in metres, 10 mm are 0.01.");
        }
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


  void
  check_geometry(const Scene &scene, Findings &findings)
  {
    struct Solid
    {
      std::string      name;
      const Rectangle *shape;
      bool             rigid;
    };
    std::vector<Solid> solids;
    for (const ParticleBody &body : scene.particle_bodies)
      solids.push_back({body.name, &body.shape, false});
    for (const RigidBody &body : scene.rigid_bodies)
      solids.push_back({body.name, &body.shape, true});

    check_rectangle(scene.domain, "Domain", findings);
    for (const Solid &solid : solids)
      check_rectangle(*solid.shape, "Body " + solid.name + "/Shape", findings);
    if (!findings.clean())
      return;

    for (std::size_t i = 0; i < solids.size(); ++i)
      {
        check_inside_domain(
            *solids[i].shape, solids[i].name, scene.domain, findings);
        for (std::size_t j = 0; j < i; ++j)
          {
            const double common = overlap(*solids[i].shape, *solids[j].shape);
            if (common <= 1e-9 * scene.domain.extent(0))
              continue;
            const std::string text = "the body overlaps '" + solids[j].name +
                                     "' by " + number_text(common) + " m";
            const std::string path =
                "Body " + solids[i].name + "/Shape/Lower corner";
            if (solids[i].rigid && solids[j].rigid)
              findings.advise(path, text + ".");
            else
              findings.mistake(path, text + "; move one of them.");
          }
      }
    if (!(scene.depth > 0.))
      findings.mistake("Depth", "it must be positive, in m.");
    else if (scene.depth > 1.)
      findings.advise("Depth",
                      "it is in metres; 10 mm are 0.01, and 1 gives "
                      "results per metre.");
  }
} // namespace Morsel::Scene
