#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>

#include <algorithm>

namespace Morsel::Scene
{
  namespace
  {
    void
    check_updated(const ParticleBody &body,
                  const Scene        &scene,
                  Findings           &findings)
    {
      const SPH::SolidParameters &solid   = body.solid;
      const std::string           section = "Body " + body.name + "/Solid/";
      if (!scene.plate_bodies.empty())
        findings.mistake(section + "Formulation",
                         "scenes with plates are computed in the total "
                         "Lagrangian form; the updated one clumps in tension "
                         "and is there for comparison, without plates.");
      if (findings.is_given(section + "Hourglass coefficient") &&
          solid.hourglass > 0.)
        findings.mistake(section + "Hourglass coefficient",
                         "the updated Lagrangian form has no reference fit "
                         "whose residual could be held; give 0 or leave it "
                         "out.");
      if (findings.is_given("Body " + body.name + "/Material/Law") &&
          body.material.law != "linear")
        findings.advise("Body " + body.name + "/Material/Law",
                        "the updated Lagrangian form has Hooke's law in the "
                        "Jaumann rate, whatever the law.");
      if (body.normalisation() == "conforming")
        findings.mistake(section + "Normalisation",
                         "the conforming gradient belongs to cells of the "
                         "reference configuration; take 'Formulation' = 'total "
                         "Lagrangian' or another normalisation.");
      if (solid.artificial_stress > 0. && solid.viscosity != "on")
        findings.advise(section + "Artificial stress",
                        "without viscosity it makes noise ten times the "
                        "stress; set 'Viscosity' = 'on'.");
      if (solid.artificial_stress > 0.1)
        findings.advise(section + "Artificial stress",
                        "0.3 raises the stress by 15 % and more, 0.05 by 2 %: "
                        "compare with the total Lagrangian form.");
      if (solid.artificial_stress == 0.)
        findings.advise(section + "Formulation",
                        "without artificial stress the updated Lagrangian form "
                        "breaks numerically between 0.5 and 2 % of tension.");
    }


    void
    check_grains(const ParticleBody &body, Findings &findings)
    {
      const Materials::GrainParameters &grains  = body.grains;
      const std::string                 section = "Body " + body.name + "/";
      const bool                        asked =
          grains.modulus_scatter > 0. || grains.strength_scatter > 0.;
      if (grains.size == 0.)
        {
          if (asked)
            findings.advise(section + "Grains/Size",
                            "without a size there are no grains that could "
                            "scatter; give their mean diameter in m.");
          return;
        }
      if (!asked)
        findings.advise(section + "Grains/Size",
                        "all grains are alike; give 'Modulus scatter' or "
                        "'Strength scatter'.");
      if (body.solid.is_updated())
        findings.mistake(section + "Grains/Size",
                         "the updated Lagrangian form has no grains; give 0 or "
                         "take 'Formulation' = 'total Lagrangian'.");
      if (grains.strength_scatter > 0. && !body.damage.enabled)
        findings.advise(section + "Grains/Strength scatter",
                        "a solid that cannot fail (Damage/Enabled) has no "
                        "thresholds.");
      if (grains.size < 3. * body.spacing)
        findings.advise(section + "Grains/Size",
                        "grains of " + number_text(grains.size / body.spacing) +
                            " particle spacings are hardly resolved, and what "
                            "the body does depends on the spacing; take at "
                            "least 3, better 6.");
      if (!body.cracks.paths.empty() && grains.scatter_modulus())
        findings.advise(section + "Grains/Modulus scatter",
                        "stress intensity factors are evaluated with one "
                        "modulus, the material's.");
    }


    void
    check_normalisation(const ParticleBody &body, Findings &findings)
    {
      const std::string path = "Body " + body.name + "/Solid/Normalisation";
      const std::string normalisation = body.normalisation();
      if (normalisation == "none" || normalisation == "Shepard")
        findings.advise(path,
                        "strains at edges and corners are half wrong, and the "
                        "body is far too soft; take 'gradient matrix' but for "
                        "comparison.");
      if (normalisation == "per axis")
        findings.advise(path,
                        "exact for axial strains on a lattice only: rotation "
                        "makes spurious strain at corners and on clouds. (It "
                        "is applied to gradients of displacement or velocity; "
                        "applied to positions it would strain a body at "
                        "rest.)");
      if (!body.is_even_lattice() && normalisation != "conforming" &&
          !body.solid.is_updated())
        findings.advise(path,
                        normalisation == "gradient matrix"
                            ? "on uneven particles a constant stress makes "
                              "forces with the gradient matrix, and energies "
                              "are far too low; take 'conforming'."
                            : "on uneven particles only the gradient matrix "
                              "and the conforming gradient are exact for "
                              "linear fields.");
    }


    /// By how much of its extent along an axis plates at constant speed press
    /// a body together, unless it fails: those that stand before its sides and
    /// come towards it.
    double
    pressed_share(const ParticleBody &body,
                  const Scene        &scene,
                  const unsigned int  axis)
    {
      const Rectangle &food = body.shape;
      double           way  = 0.;
      for (const PlateBody &plate : scene.plate_bodies)
        {
          const Jaw::MotionParameters &motion = plate.motion;
          const Rectangle              box = plate.shape.box_before(axis, food);
          const bool                   beside =
              box.upper_corner[1 - axis] <= food.lower_corner[1 - axis] ||
              box.lower_corner[1 - axis] >= food.upper_corner[1 - axis];
          if (motion.kind != "constant" || beside)
            continue;
          const double above = box.lower_corner[axis] - food.upper_corner[axis];
          const double below = food.lower_corner[axis] - box.upper_corner[axis];
          const double speed =
              above > below ? -motion.velocity[axis] : motion.velocity[axis];
          way += std::max(0.,
                          speed * (scene.time.end_time - motion.delay()) -
                              std::max({0., above, below}));
        }
      return std::min(scene.stop.maximum_closure, way / food.extent(axis));
    }


    /// The linear law may be scaled at will where all else is linear, too;
    /// between plates it may not.
    void
    check_law(const ParticleBody &body, const Scene &scene, Findings &findings)
    {
      if (body.material.law != "linear" || body.damage.enabled)
        return;
      const double      share = std::max(pressed_share(body, scene, 0),
                                    pressed_share(body, scene, 1));
      const std::string path  = "Body " + body.name + "/Material/Law";
      const std::string text  = "the plates press '" + body.name +
                               "' together by " + number_text(100. * share) +
                               " %, and the linear law holds for small strains";
      if (share > 0.5)
        findings.mistake(path,
                         text + "; take 'neo-Hookean', or end the run at half "
                                "of it ('Stop/Maximum closure').");
      else if (share > 0.1)
        findings.advise(path, text + ": 'neo-Hookean' is for large ones.");
    }
  } // namespace


  void
  check_formulation(const ParticleBody &body,
                    const Scene        &scene,
                    Findings           &findings)
  {
    if (body.damage.enabled)
      check_damage(body, scene, findings);
    if (body.solid.is_updated())
      check_updated(body, scene, findings);
    else if (body.solid.artificial_stress > 0.)
      findings.mistake("Body " + body.name + "/Solid/Artificial stress",
                       "the total Lagrangian form has no tensile instability "
                       "that it could cure, and it would bias the stress; give "
                       "0 or take 'Formulation' = 'updated Lagrangian'.");
    if (!body.initial_stress.empty() && !body.solid.is_updated())
      findings.mistake("Body " + body.name + "/Particles/Initial stress",
                       "the total Lagrangian form has its stress from the "
                       "deformation; leave it out or take 'Formulation' = "
                       "'updated Lagrangian'.");
    check_law(body, scene, findings);
    check_grains(body, findings);
    check_normalisation(body, findings);
  }
} // namespace Morsel::Scene
