#include <morsel/core/errors.h>
#include <morsel/scene/findings.h>

namespace Morsel::Scene
{
  namespace
  {
    void
    check_static_body(const ParticleBody &body, Findings &findings)
    {
      const std::string section = "Body " + body.name + "/";
      const auto        refuse  = [&](const bool         wrong,
                              const std::string &entry,
                              const std::string &why) {
        if (wrong)
          findings.mistake(section + entry, why);
      };
      refuse(body.damage.enabled,
             "Damage/Enabled",
             "a static solution is elastic: damage grows over time; take "
             "'Time/Solution' = 'transient'.");
      refuse(body.grains.size > 0.,
             "Grains/Size",
             "a static solution has no grains; give 0 or take "
             "'Time/Solution' = 'transient'.");
      refuse(body.solid.is_updated(),
             "Solid/Formulation",
             "equilibrium at small strain is found in the reference "
             "configuration; take 'total Lagrangian'.");
      refuse(body.solid.artificial_stress > 0.,
             "Solid/Artificial stress",
             "a static solution has no tensile instability to cure; give 0.");
      refuse(body.initial_velocity.norm() > 0.,
             "Particles/Initial velocity",
             "nothing moves in a static solution; leave it out.");
      refuse(!body.initial_velocity_field.empty(),
             "Particles/Initial velocity field",
             "nothing moves in a static solution; leave it out.");
      refuse(!body.expected_velocity_gradient.empty(),
             "Particles/Expected velocity gradient",
             "nothing moves in a static solution; leave it out.");
      if (body.material.law != "linear" &&
          findings.is_given(section + "Material/Law"))
        findings.advise(section + "Material/Law",
                        "at small strain every law is the linear one.");
    }


    void
    check_static(const Scene &scene, Findings &findings)
    {
      if (!scene.plate_bodies.empty())
        findings.mistake("Time/Solution",
                         "plates move and their contact is a transient; leave "
                         "out the rigid bodies, or take 'transient'.");
      for (const ParticleBody &body : scene.particle_bodies)
        check_static_body(body, findings);
      for (const Condition &condition : scene.conditions)
        if (condition.kind == "velocity")
          findings.mistake("Condition " + condition.name + "/Kind",
                           "nothing moves in a static solution; prescribe a "
                           "'displacement'.");
        else if (condition.kind == "damping")
          findings.mistake("Condition " + condition.name + "/Kind",
                           "a static solution is at rest without damping; "
                           "leave the condition out.");
      for (const Observer &observer : scene.observers)
        if (observer.frequency != "none")
          findings.mistake("Observer " + observer.name + "/Frequency of",
                           "a static solution does not oscillate; give "
                           "'none'.");
    }


    void
    check_transient(const Scene &scene, Findings &findings)
    {
      for (const ParticleBody &body : scene.particle_bodies)
        {
          const std::string section = "Body " + body.name + "/";
          if (!body.expected_velocity_gradient.empty() &&
              !body.is_plain_lattice())
            findings.mistake(section + "Particles/Expected velocity gradient",
                             "edges and corners are told apart on a "
                             "rectangle's lattice only; leave it out.");
          if (!body.expected_displacement_field.empty())
            findings.mistake(section + "Particles/Expected displacement field",
                             "it is compared with static solutions alone.");
          if (body.material.plane_stress)
            findings.mistake(section + "Material/Plane stress",
                             "transients are computed in plane strain.");
        }
      for (const Condition &condition : scene.conditions)
        {
          if (condition.kind == "displacement")
            findings.mistake("Condition " + condition.name + "/Kind",
                             "over time a 'velocity' is prescribed.");
          for (const ParticleBody &body : scene.particle_bodies)
            if (body.name == condition.body && condition.on_side() &&
                !body.is_plain_lattice())
              findings.mistake("Condition " + condition.name + "/Where",
                               "over time, sides are loaded and held on a "
                               "rectangle's lattice only; give a 'box' or "
                               "'everywhere', or set 'Time/Solution' = "
                               "'static'.");
        }
    }
  } // namespace


  void
  check_solution(const Scene &scene, Findings &findings)
  {
    if (scene.time.is_static())
      check_static(scene, findings);
    else
      check_transient(scene, findings);
  }
} // namespace Morsel::Scene
