#include "recorder.h"
#include "run_summary.h"

#include <algorithm>

namespace Morsel
{
  namespace
  {
    /// What plates and teeth do beside being pressed on.
    void
    add_effects_of_plates(const Scene::Scene          &scene,
                          std::vector<Output::Effect> &effects)
    {
      const auto any = [&scene](const auto &is) {
        return std::any_of(
            scene.plate_bodies.begin(), scene.plate_bodies.end(), is);
      };
      effects.push_back({"plates that deform",
                         any([](const Scene::PlateBody &plate) {
                           return plate.deformation.elastic &&
                                  plate.deformation.response != "rigid";
                         }),
                         "Body <plate>/Deformation/Response"});
      effects.push_back({"cracks in plates",
                         any([](const Scene::PlateBody &plate) {
                           return !plate.cracks.paths.empty();
                         }),
                         "Body <plate>/Cracks/Paths"});
      effects.push_back({"plates that the food slows",
                         any([](const Scene::PlateBody &plate) {
                           return !plate.motion.is_prescribed();
                         }),
                         "Body <plate>/Motion/Kind"});
      effects.push_back({"contact between plates",
                         !scene.plate_pairs.empty(),
                         "Contact/Pairs"});
      effects.push_back({"contact between particle bodies",
                         !scene.food_pairs.empty(),
                         "Contact/Pairs"});
      effects.push_back(
          {"supports and loads", !scene.conditions.empty(), "Conditions"});
    }
  } // namespace


  std::vector<Output::Effect>
  effects_of(const Scene::Scene &scene)
  {
    const auto       &body      = scene.particle_bodies.front();
    const std::string where     = "Body " + body.name + "/";
    const bool        can_fail  = body.damage.enabled;
    const bool        viscosity = body.solid.viscosity == "on" ||
                           (body.solid.viscosity == "auto" && can_fail);

    std::vector<Output::Effect> effects;
    effects.push_back(
        {"elastic solid (" + body.material.law + ")", true, where + "Kind"});
    effects.push_back(
        {"cracks", !body.cracks.paths.empty(), where + "Cracks/Paths"});
    for (const auto &plate : scene.plate_bodies)
      if (!plate.cracks.paths.empty())
        effects.push_back({"cracks in " + plate.name,
                           true,
                           "Body " + plate.name + "/Cracks/Paths"});
    effects.push_back({"hourglass control",
                       body.solid.hourglass > 0.,
                       where + "Solid/Hourglass coefficient"});
    effects.push_back({"artificial viscosity",
                       viscosity,
                       body.solid.viscosity == "auto"
                           ? std::string("auto: the solid can") +
                                 (can_fail ? "" : "not") + " fail"
                           : where + "Solid/Viscosity"});
    effects.push_back({"damage (" + body.damage.driver + ", " +
                           body.damage.growth + ", " + body.damage.softening +
                           ", " + body.damage.flaws + " flaws)",
                       can_fail,
                       where + "Damage/Enabled"});
    effects.push_back({"granular response of failed food",
                       can_fail,
                       "implied by damage; costs nothing until something has "
                       "failed"});
    effects.push_back(effect_of_grains(body));
    effects.push_back({"contact with plates (" + scene.contact.law + ")",
                       !scene.contact_pairs.empty(),
                       "Contact/Pairs"});
    effects.push_back(
        {"friction on plates",
         !scene.contact_pairs.empty() && scene.contact.friction > 0.,
         "Contact/Friction"});
    add_effects_of_plates(scene, effects);
    effects.push_back({"fields", scene.output.fields, "Output/Fields"});
    return effects;
  }
} // namespace Morsel
