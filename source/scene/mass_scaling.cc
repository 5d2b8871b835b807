#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>
#include <morsel/scene/mass_scaling.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Scene
{
  namespace
  {
    /// Waves carry more than the even motion that the rule counts: up to a
    /// fourth more, as strokes on a peanut at 10 to 50 mm/s show.
    constexpr double share_of_even_motion = 0.75;


    double
    fastest_plate(const Scene &scene)
    {
      double speed = 0.;
      for (const PlateBody &plate : scene.plate_bodies)
        speed = std::max(speed, plate.motion.typical_velocity().norm());
      return speed;
    }


    /// That the food reaches at most [Pa].
    double
    largest_stress(const ParticleBody &body, const Scene &scene)
    {
      const double nu      = body.material.poissons_ratio;
      const double modulus = body.material.youngs_modulus / (1. - nu * nu);
      const double height =
          std::min(body.shape.extent(0), body.shape.extent(1));
      const double strain =
          std::min(scene.stop.maximum_closure,
                   fastest_plate(scene) * scene.time.end_time / height);
      return body.damage.enabled ? body.material.compressive_strength
                                 : modulus * strain;
    }


    /// What the inertia of a body of particles is needed for.
    void
    check_body(const ParticleBody &body, Findings &findings)
    {
      const std::string section = "Body " + body.name + "/";
      const std::string leave   = " Leave 'Time/Mass scaling' at 1.";
      if (body.initial_velocity.norm() > 0.)
        findings.mistake(section + "Particles/Initial velocity",
                         "what flies has the mass of its material." + leave);
      if (!body.initial_velocity_field.empty())
        findings.mistake(section + "Particles/Initial velocity field",
                         "what moves at first has the mass of its material." +
                             leave);
      if (body.damage.enabled && body.damage.growth == "Grady-Kipp")
        findings.mistake(section + "Damage/Growth",
                         "it grows with the speed of waves, which a scaled "
                         "mass changes; take a growth that knows no rate, or "
                         "leave 'Time/Mass scaling' at 1.");
    }


    void
    check_plate(const PlateBody &plate, Findings &findings)
    {
      const std::string section = "Body " + plate.name + "/";
      if (!plate.motion.is_prescribed())
        findings.mistake(section + "Motion/Kind",
                         "what the food slows down has a mass of its own, with "
                         "which the food's would have to agree; prescribe the "
                         "motion, or leave 'Time/Mass scaling' at 1.");
      if (plate.deformation.elastic &&
          (plate.deformation.response == "dynamic" ||
           plate.deformation.held_sides.empty()))
        findings.mistake(section + "Deformation/Response",
                         "the body answers by its inertia, which the scaling "
                         "of the food's mass leaves alone; hold it and take "
                         "'rigid' or 'quasi-static', or leave 'Time/Mass "
                         "scaling' at 1.");
    }
  } // namespace


  double
  inertia_factor(const Scene &scene)
  {
    if (scene.time.mass_scaling > 0. || scene.particle_bodies.empty())
      return scene.time.mass_scaling > 0. ? scene.time.mass_scaling : 1.;
    const double speed  = fastest_plate(scene);
    double       factor = HUGE_VAL;
    for (const ParticleBody &body : scene.particle_bodies)
      {
        const double nu      = body.material.poissons_ratio;
        const double modulus = body.material.youngs_modulus / (1. - nu * nu);
        const double stress  = largest_stress(body, scene);
        factor               = std::min(
            factor,
            3. * share_of_even_motion * scene.time.kinetic_share * stress *
                stress / (body.material.density * speed * speed * modulus));
      }
    return std::isfinite(factor) ? std::max(1., factor) : 1.;
  }


  void
  check_mass_scaling(const Scene &scene, Findings &findings)
  {
    const double      given = scene.time.mass_scaling;
    const std::string path  = "Time/Mass scaling";
    if (given == 1.)
      return;
    if (given > 0. && given < 1.)
      findings.mistake(path,
                       "less mass makes steps smaller; give 1 for none, more, "
                       "or 0 for what 'Kinetic share' allows.");
    if (scene.time.is_static())
      findings.mistake(path, "a static solution has no inertia; give 1.");
    if (given == 0. && fastest_plate(scene) == 0.)
      findings.mistake(path,
                       "no plate moves as prescribed, by which a factor could "
                       "be chosen; give one, or 1.");
    for (const ParticleBody &body : scene.particle_bodies)
      check_body(body, findings);
    for (const PlateBody &plate : scene.plate_bodies)
      check_plate(plate, findings);
    for (const Condition &condition : scene.conditions)
      if (condition.kind == "acceleration")
        findings.mistake("Condition " + condition.name + "/Kind",
                         "it would pull at the scaled mass; give the load as a "
                         "force, or leave 'Time/Mass scaling' at 1.");
    for (const Observer &observer : scene.observers)
      if (observer.frequency != "none")
        findings.mistake("Observer " + observer.name + "/Frequency of",
                         "a scaled mass oscillates at another frequency; give "
                         "'none', or leave 'Time/Mass scaling' at 1.");
  }
} // namespace Morsel::Scene
