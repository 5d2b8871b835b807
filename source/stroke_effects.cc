#include "recorder.h"
#include "run_summary.h"

#include <algorithm>

namespace Morsel
{
  namespace
  {
    /// Parts of a run, see Bite.
    constexpr const char *bonded   = "strain and forces";
    constexpr const char *touching = "contact with plates";

    /// Where it was found out what an effect is worth.
    const std::string of_study =
        "peanut between flat plates (prm/studies/breaking/effects.prm): ";


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
                         "Body <plate>/Deformation/Response",
                         touching});
      effects.push_back({"cracks in plates",
                         any([](const Scene::PlateBody &plate) {
                           return !plate.cracks.paths.empty();
                         }),
                         "Body <plate>/Cracks/Paths",
                         touching});
      effects.push_back({"plates that the food slows",
                         any([](const Scene::PlateBody &plate) {
                           return !plate.motion.is_prescribed();
                         }),
                         "Body <plate>/Motion/Kind"});
      effects.push_back({"contact between plates",
                         !scene.plate_pairs.empty(),
                         "Contact/Pairs",
                         touching});
      effects.push_back({"contact between particle bodies",
                         !scene.food_pairs.empty(),
                         "Contact/Pairs",
                         touching});
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

    // Bodies that are worked on together share the time of a part.
    const bool                  alone = scene.particle_bodies.size() == 1;
    std::vector<Output::Effect> effects;
    const auto                  add = [&effects](const std::string &name,
                                const bool         on,
                                const std::string &reason,
                                const char        *part,
                                const bool         fills_part = false,
                                const std::string &without = "") {
      effects.push_back({name, on, reason, part, fills_part, without});
    };
    add("elastic solid (" + body.material.law + ")",
        true,
        where + "Kind",
        bonded,
        alone,
        of_study + "small strain: peak force -0.3 %, fragments +4 +- 3 %");
    add("cracks", !body.cracks.paths.empty(), where + "Cracks/Paths", bonded);
    for (const auto &plate : scene.plate_bodies)
      if (!plate.cracks.paths.empty())
        add("cracks in " + plate.name,
            true,
            "Body " + plate.name + "/Cracks/Paths",
            touching);
    add("hourglass control",
        body.solid.hourglass > 0.,
        where + "Solid/Hourglass coefficient",
        bonded,
        false,
        of_study + "peak force -2.3 +- 0.2 %, fragments +4 +- 6 %, dust +9 +- "
                   "5 %, energy balance 6 times as far off");
    add("artificial viscosity",
        viscosity,
        body.solid.viscosity == "auto" ? std::string("auto: the solid can") +
                                             (can_fail ? "" : "not") + " fail"
                                       : where + "Solid/Viscosity",
        bonded,
        false,
        of_study + "peak force -0.7 +- 0.1 %, fragments -54 +- 4 %, dust +104 "
                   "+- 2 %, energy balance 12 times as far off");
    add("damage (" + body.damage.driver + ", " + body.damage.growth + ", " +
            body.damage.softening + ", " + body.damage.flaws + " flaws)",
        can_fail,
        where + "Damage/Enabled",
        "damage and broken bonds",
        alone);
    add("granular response of failed food",
        can_fail,
        "implied by damage; costs nothing until something has failed",
        "failed food",
        alone);
    effects.push_back(effect_of_grains(body));
    add("contact with plates (" + scene.contact.law + ")",
        !scene.contact_pairs.empty(),
        "Contact/Pairs",
        touching,
        true);
    add("friction on plates",
        !scene.contact_pairs.empty() && scene.contact.friction > 0.,
        "Contact/Friction",
        touching,
        false,
        of_study + "peak force -1.5 +- 0.2 %, fragments +3 +- 9 %, dust -13 +- "
                   "3 %");
    add_effects_of_plates(scene, effects);
    add("fields", scene.output.fields, "Output/Fields", "output", true);
    return effects;
  }
} // namespace Morsel
