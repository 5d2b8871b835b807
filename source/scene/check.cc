#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/materials/elasticity.h>
#include <morsel/scene/check.h>
#include <morsel/scene/findings.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Morsel::Scene
{
  namespace
  {
    /// Longitudinal wave speed and stable step of a body with the mass that its
    /// inertia has, once its material is known to be sound.
    struct WaveLimits
    {
      double speed;  ///< c [m/s]
      double step;   ///< h/c [s]
      double height; ///< [m]
    };


    WaveLimits
    wave_limits(const ParticleBody &body, const Scene &scene)
    {
      const double speed = Materials::Elasticity(body.material.youngs_modulus,
                                                 body.material.poissons_ratio,
                                                 scene.time.inertia_factor *
                                                     body.material.density)
                               .wave_speed;
      return {speed,
              body.solid.smoothing_ratio * body.spacing / speed,
              body.shape.extent(1)};
    }


    void
    check_material(const ParticleBody &body,
                   const Scene        &scene,
                   Findings           &findings)
    {
      const std::string section = "Body " + body.name + "/Material/";
      const Materials::MaterialParameters &material = body.material;
      const std::string                    inline_advice =
          material.name == "inline"
                                 ? " Give it, or name a material of the catalogue."
                                 : "";
      // In equilibrium only an acceleration asks for the mass.
      const bool has_mass =
          !scene.time.is_static() ||
          std::any_of(scene.conditions.begin(),
                      scene.conditions.end(),
                      [](const Condition &condition) {
                        return condition.kind == "acceleration";
                      });
      if (has_mass && !(material.density > 0.))
        findings.mistake(section + "Density",
                         "the density must be positive, in kg/m^3." +
                             inline_advice);
      if (!(material.youngs_modulus > 0.))
        findings.mistake(section + "Young's modulus",
                         "Young's modulus must be positive, in Pa." +
                             inline_advice);
      if (!(material.poissons_ratio >= 0. && material.poissons_ratio < 0.5))
        findings.mistake(section + "Poisson's ratio",
                         "Poisson's ratio must be at least 0 and below 0.5." +
                             inline_advice);
      else if (material.poissons_ratio > 0.49)
        findings.advise(section + "Poisson's ratio",
                        "the solid is nearly incompressible: the time step "
                        "becomes small and the answer stiff.");
      if (material.density > 0. &&
          (material.density < 50. || material.density > 25000.))
        findings.advise(section + "Density",
                        number_text(material.density) +
                            " kg/m^3 is unusual; water has 1000.");

      const double strength = material.compressive_strength;
      if (body.damage.enabled && !(strength > 0.))
        findings.mistake("Body " + body.name + "/Damage/Enabled",
                         "the solid can fail only if its strength is known: "
                         "give 'Compressive strength' or 'Toughness' in '" +
                             section.substr(0, section.size() - 1) + "'.");
      if (strength > 0. && material.youngs_modulus > 0.)
        {
          const double      failure_strain = strength / material.youngs_modulus;
          const std::string text =
              "the strength " + number_text(strength) +
              " Pa over the modulus is a failure strain of " +
              number_text(failure_strain);
          if (failure_strain > 1.)
            findings.mistake(section + "Young's modulus",
                             text + ": check the units, both are in Pa.");
          else if (failure_strain > 0.2 || failure_strain < 1e-6)
            findings.advise(section + "Young's modulus",
                            text + ", which is suspicious; both are in Pa.");
        }
    }


    /// The fastest of the plates that may touch a body [m/s].
    std::optional<PlateBody>
    fastest_plate(const ParticleBody &body, const Scene &scene)
    {
      std::optional<PlateBody> fastest;
      for (const ContactPair &pair : scene.contact_pairs)
        for (const PlateBody &plate : scene.plate_bodies)
          if (pair.food == body.name && pair.plate == plate.name &&
              (!fastest || plate.motion.typical_velocity().norm() >
                               fastest->motion.typical_velocity().norm()))
            fastest = plate;
      return fastest;
    }


    /// A way of approach has room for its ramp.
    void
    check_approach(const PlateBody &plate, Findings &findings)
    {
      const Jaw::MotionParameters &motion = plate.motion;
      const std::string path  = "Body " + plate.name + "/Motion/Approach";
      const double      speed = motion.velocity.norm() * motion.approach_factor;
      if (motion.approach_share > 0. && motion.approach == 0.)
        findings.mistake(path,
                         "it is a share of the way to the food's failure; give "
                         "0 where no body can fail or this one stands still.");
      else if (motion.approach > 0. &&
               speed * motion.ramp_time > motion.approach)
        findings.mistake(path,
                         "half of it, " + number_text(0.5 * motion.approach) +
                             " m, is too short for the ramp to " +
                             number_text(speed) +
                             " m/s; give more, a smaller 'Approach factor' or "
                             "a 'Ramp time' of at most " +
                             number_text(motion.approach / speed) + " s.");
    }


    /// The step from which the run still comes to a stable one by its retries.
    double
    largest_halved(const Scene &scene, const double stable)
    {
      return std::ldexp(stable, scene.time.retries);
    }


    void
    check_numerics(const ParticleBody &body,
                   const Scene        &scene,
                   Findings           &findings)
    {
      const WaveLimits  limits  = wave_limits(body, scene);
      const std::string section = "Body " + body.name + "/Solid/";
      if (4. * body.solid.smoothing_ratio >
          std::min(body.particles_across, body.particles_high()))
        findings.advise(section + "Smoothing ratio",
                        "the support of a particle is as large as the body; "
                        "take more particles or a smaller ratio.");
      if (body.solid.smoothing_ratio < 1.2 || body.solid.smoothing_ratio > 2.)
        findings.advise(section + "Smoothing ratio",
                        "1.2 to 2 spacings are usual; fewer neighbours make "
                        "the gradient poor, more make it slow and blurred.");
      if (body.solid.cfl > 1.)
        findings.advise(section + "CFL factor",
                        "the scheme is stable up to about 1.");

      const double      step = scene.time.time_step;
      const std::string unstable =
          "it exceeds the stable step h/c = " + number_text(limits.step) +
          " s of '" + body.name + "' (wave speed " + number_text(limits.speed) +
          " m/s); ";
      if (step > largest_halved(scene, limits.step))
        findings.mistake("Time/Time step",
                         unstable + "give less, or 0 for the stable step.");
      else if (step > limits.step)
        findings.advise("Time/Time step",
                        unstable + "the run will have to go back and halve "
                                   "it ('Time/Retries').");
      else if (step > 0.7 * limits.step)
        findings.advise("Time/Time step",
                        "it is close to the stable step h/c = " +
                            number_text(limits.step) + " s of '" + body.name +
                            "'; contact and viscosity may need less.");

      const double expected_step =
          step > 0. ? step : body.solid.cfl * limits.step;
      if (scene.time.end_time / expected_step > 1e8)
        findings.advise("Time/End time",
                        "the run may take " +
                            number_text(scene.time.end_time / expected_step) +
                            " steps of " + number_text(expected_step) +
                            " s; a faster plate or fewer particles reduce "
                            "them.");
    }


    void
    check_contact(const ParticleBody &body,
                  const Scene        &scene,
                  Findings           &findings)
    {
      const WaveLimits limits = wave_limits(body, scene);
      const double     step   = scene.time.time_step;

      // A particle (rho dp^2) on a spring of stiffness s (lambda + 2 mu) per
      // unit depth oscillates at sqrt(s) c/dp; leapfrog needs dt < 2/omega.
      const bool   gap_penalty = scene.contact.law == "gap penalty";
      const double stiffness   = scene.contact.stiffness;
      const double contact_step =
          2. * body.spacing / (limits.speed * std::sqrt(stiffness));
      if (gap_penalty && step > largest_halved(scene, contact_step))
        findings.mistake("Contact/Stiffness",
                         "the time step " + number_text(step) +
                             " s is too large for it: a particle in contact "
                             "needs less than " +
                             number_text(contact_step) +
                             " s; lower the stiffness or the step.");
      if (gap_penalty && stiffness > 10.)
        findings.advise("Contact/Stiffness",
                        "so stiff a contact reduces the time step by about " +
                            number_text(std::sqrt(stiffness)) +
                            "; 0.1 to 2 are usual.");
      if (gap_penalty && stiffness < 0.05 && !scene.contact_pairs.empty())
        findings.advise("Contact/Stiffness",
                        "so soft a contact lets the food sink into the plate "
                        "by many spacings; 0.1 to 2 are usual.");
    }


    void
    check_loading(const ParticleBody &body,
                  const Scene        &scene,
                  Findings           &findings)
    {
      const WaveLimits limits = wave_limits(body, scene);
      if (body.initial_velocity.norm() > 0.1 * limits.speed)
        findings.advise("Body " + body.name + "/Particles/Initial velocity",
                        "it is more than a tenth of the wave speed " +
                            number_text(limits.speed) + " m/s.");

      const std::optional<PlateBody> plate = fastest_plate(body, scene);
      if (!plate)
        return;
      const std::string path  = "Body " + plate->name + "/Motion/Velocity";
      const double      speed = plate->motion.typical_velocity().norm();
      if (speed > 0.1 * limits.speed)
        findings.advise(path,
                        "it is more than a tenth of the wave speed " +
                            number_text(limits.speed) +
                            " m/s: this is an impact, not chewing.");
      else if (speed > 0. && body.material.compressive_strength > 0.)
        {
          const double transits = body.material.compressive_strength /
                                  body.material.youngs_modulus * limits.speed /
                                  speed;
          if (transits < 3.)
            findings.advise(path,
                            "the food reaches its strength within " +
                                number_text(transits) +
                                " transits of a wave: the loading is not "
                                "quasi-static, so inertia shows in the "
                                "force; a slower plate helps.");
        }
    }


    /// Says how far apart the bodies of a pair are and when they meet.
    void
    check_gap(const ContactPair &pair, const Scene &scene, Findings &findings)
    {
      const auto food = std::find_if(
          scene.particle_bodies.begin(),
          scene.particle_bodies.end(),
          [&](const ParticleBody &b) { return b.name == pair.food; });
      const auto plate = std::find_if(
          scene.plate_bodies.begin(),
          scene.plate_bodies.end(),
          [&](const PlateBody &b) { return b.name == pair.plate; });
      const double gap = gap_between(*food, *plate);
      // The potential reaches 1.5 spacings from a particle's centre, which
      // lies half a spacing inside of the food.
      if (scene.contact.law == "potential" && gap < (1. - 1e-6) * food->spacing)
        findings.mistake(
            "Body " + plate->name + "/Shape/Lower corner",
            "the plate stands " + number_text(gap) + " m off '" + food->name +
                "', within the range of the contact potential, "
                "which would push at once; begin at least one "
                "particle spacing (" +
                number_text(food->spacing) +
                " m) away, or take 'Contact/Law' = 'gap penalty'.");
      if (gap <= 1.01 * food->spacing)
        return;

      if (!plate->motion.is_prescribed())
        return;
      const double speed =
          (plate->motion.typical_velocity() - food->initial_velocity).norm();
      std::string text = "the plate stands " + number_text(gap) + " m off '" +
                         food->name + "'";
      if (gap > speed * scene.time.end_time)
        text += " and does not reach it before the end time";
      else
        text += ", a way that takes " + number_text(gap / speed) + " s";
      findings.advise("Body " + plate->name + "/Shape/Lower corner",
                      text + ".");
    }


    void
    check_run(const Scene &scene, Findings &findings)
    {
      if (!(scene.time.end_time > 0.))
        findings.mistake("Time/End time", "it must be positive, in s.");
      const double closure = scene.stop.maximum_closure;
      // What comes from afar may close by more than the food's height.
      const bool from_afar =
          std::any_of(scene.plate_bodies.begin(),
                      scene.plate_bodies.end(),
                      [](const PlateBody &plate) {
                        return plate.motion.kind != "constant";
                      });
      if (!(closure > 0. && (closure < 1. || from_afar)))
        findings.mistake("Stop/Maximum closure",
                         "it must lie between 0 and 1, as a share of the "
                         "food's height.");
      else if (closure > 0.9)
        findings.advise("Stop/Maximum closure",
                        "the food would be pressed to a tenth of its height.");
      if (scene.stop.residual_force >= 1.)
        findings.mistake("Stop/Residual force",
                         "it must be below 1, or the run ends at its peak.");
      if (scene.name.find('/') != std::string::npos)
        findings.mistake("Name",
                         "it becomes the name of a folder and must not "
                         "contain '/'.");
      if (scene.particle_bodies.empty())
        findings.mistake("Bodies",
                         "no body has particles, so there is nothing to "
                         "simulate; give one the Kind 'particles'.");
      if (scene.contact.law == "potential")
        for (const PlateBody &plate : scene.plate_bodies)
          for (const ParticleBody &food : scene.particle_bodies)
            if (plate.node_spacing > 0.6 * food.spacing)
              findings.advise("Body " + plate.name + "/Surface/Node spacing",
                              "with the potential, nodes farther apart than "
                              "half a particle spacing (" +
                                  number_text(0.5 * food.spacing) +
                                  " m) make the force ripple.");
    }
  } // namespace


  std::vector<std::string>
  check_scene(const Scene                       &scene,
              const std::vector<ParameterEntry> &entries,
              const std::string                 &file_name)
  {
    Findings findings(entries, file_name);
    check_run(scene, findings);
    check_geometry(scene, findings);
    for (const PlateBody &body : scene.plate_bodies)
      if (body.deformation.elastic)
        check_elastic(body, scene, findings);
    for (const ParticleBody &body : scene.particle_bodies)
      {
        check_particles(body, scene, findings);
        check_material(body, scene, findings);
      }
    // What follows divides by moduli, spacings and extents.
    if (findings.clean())
      {
        check_solution(scene, findings);
        for (const ParticleBody &body : scene.particle_bodies)
          {
            if (scene.time.is_static())
              continue;
            check_numerics(body, scene, findings);
            check_formulation(body, scene, findings);
            check_contact(body, scene, findings);
            check_loading(body, scene, findings);
          }
        for (const ContactPair &pair : scene.contact_pairs)
          check_gap(pair, scene, findings);
        for (const PlateBody &plate : scene.plate_bodies)
          check_approach(plate, findings);
        check_drives(scene, findings);
        check_mass_scaling(scene, findings);
        check_conditions(scene, findings);
      }
    if (!findings.clean())
      throw InputError(findings.mistakes);
    return findings.advice;
  }
} // namespace Morsel::Scene
