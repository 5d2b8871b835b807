#include <morsel/core/errors.h>
#include <morsel/core/expression.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Morsel::Scene
{
  namespace
  {
    /// What another kind of motion would take. Printed parameters give every
    /// entry, so that what is left at its default says nothing.
    void
    check_motion_entries(const PlateBody &plate, Findings &findings)
    {
      const Jaw::MotionParameters &motion = plate.motion;
      const struct
      {
        std::string key, kinds;
        bool        given;
      } entries[] = {{"Velocity", "constant", motion.velocity.norm() > 0.},
                     {"Ramp time", "constant, force", motion.ramp_time > 0.},
                     {"Approach", "constant", motion.approach_share > 0.},
                     {"Amplitude", "sinusoidal", motion.amplitude.norm() > 0.},
                     {"Period", "sinusoidal", motion.period > 0.},
                     {"Table file", "table", !motion.table_file.empty()},
                     {"Force", "force", motion.force.norm() > 0.},
                     {"Mass", "force", motion.mass > 0.},
                     {"Damping", "force", motion.damping > 0.}};
      for (const auto &entry : entries)
        if (entry.given && entry.kinds.find(motion.kind) == std::string::npos)
          findings.mistake("Body " + plate.name + "/Motion/" + entry.key,
                           "it belongs to the kind '" + entry.kinds +
                               "', but the motion's 'Kind' is '" + motion.kind +
                               "'; leave it out, or change the kind.");
    }


    void
    check_needed(const PlateBody &plate, Findings &findings)
    {
      const Jaw::MotionParameters &motion = plate.motion;
      const struct
      {
        std::string key, kind, text;
        bool        given;
      } needed[] = {{"Amplitude",
                     "sinusoidal",
                     "the way from one end to the other must not be 0, in m.",
                     motion.amplitude.norm() > 0.},
                    {"Period",
                     "sinusoidal",
                     "the time of one cycle must be positive, in s.",
                     motion.period > 0.},
                    {"Table file",
                     "table",
                     "name the file of the measured motion.",
                     !motion.table_file.empty()},
                    {"Force",
                     "force",
                     "the force must not be 0, in N.",
                     motion.force.norm() > 0.},
                    {"Mass",
                     "force",
                     "the moved mass must be positive, in kg.",
                     motion.mass > 0.}};
      for (const auto &entry : needed)
        if (entry.kind == motion.kind && !entry.given)
          findings.mistake("Body " + plate.name + "/Motion/" + entry.key,
                           entry.text);
    }


    /// A body with inertia of its own needs a drive that is known beforehand
    /// and does not turn.
    void
    check_response(const PlateBody &plate, Findings &findings)
    {
      if (plate.deformation.elastic &&
          plate.deformation.response == "dynamic" &&
          !plate.motion.carries_dynamic_bodies())
        findings.mistake("Body " + plate.name + "/Deformation/Response",
                         "a dynamic body follows a prescribed motion that "
                         "does not turn it; take 'quasi-static' or 'rigid'.");
    }


    void
    check_muscles(const Scene &scene, Findings &findings)
    {
      for (const Jaw::MuscleParameters &muscle : scene.muscles)
        {
          const std::string section = "Muscle " + muscle.name + "/";
          if (muscle.origin.distance(muscle.insertion) == 0.)
            findings.mistake(section + "Insertion",
                             "it is where the muscle begins; origin and "
                             "insertion must be apart.");
          if (!(muscle.maximal_force > 0.))
            findings.mistake(section + "Maximal force",
                             "it must be positive, in N.");
          try
            {
              const VectorExpression activation(muscle.activation + "; 0");
              if (!activation.is_uniform())
                throw InputError("");
            }
          catch (const InputError &)
            {
              findings.mistake(section + "Activation",
                               "it is no expression of t, such as "
                               "'min(t/0.05, 1)'.");
            }
        }
    }


    void
    check_jaw(const Scene &scene, Findings &findings)
    {
      const bool any_on_jaw = std::any_of(
          scene.plate_bodies.begin(),
          scene.plate_bodies.end(),
          [](const PlateBody &plate) { return plate.motion.kind == "jaw"; });
      if (!any_on_jaw)
        {
          if (!scene.muscles.empty())
            findings.mistake("Muscles",
                             "no body rides on the jaw that they move; give "
                             "one 'Motion/Kind' = 'jaw', or leave them out.");
          return;
        }
      if (!(scene.jaw.inertia > 0.))
        findings.mistake("Jaw/Moment of inertia",
                         "it must be positive, in kg m^2.");
      if (scene.muscles.empty() && scene.jaw.first_spin == 0.)
        findings.mistake("Muscles",
                         "nothing moves the jaw: name its muscles, or give "
                         "'Jaw/Initial speed'.");
      check_muscles(scene, findings);
    }


    /// Teeth that meet each other: what has no inertia would have to find its
    /// equilibrium with that of the other.
    void
    check_plate_pairs(const Scene &scene, Findings &findings)
    {
      for (const PairOfAKind &pair : scene.plate_pairs)
        for (const PlateBody &plate : scene.plate_bodies)
          if ((plate.name == pair.first || plate.name == pair.second) &&
              plate.deformation.elastic &&
              plate.deformation.response == "quasi-static")
            findings.mistake("Contact/Pairs",
                             "'" + pair.first + ":" + pair.second + "': '" +
                                 plate.name +
                                 "' is quasi-static and meets particles "
                                 "alone; leave the pair out, or take "
                                 "'Deformation/Response' = 'dynamic'.");
    }


    void
    check_food_pairs(const Scene &scene, Findings &findings)
    {
      for (const PairOfAKind &pair : scene.food_pairs)
        for (const ParticleBody &body : scene.particle_bodies)
          if ((body.name == pair.first || body.name == pair.second) &&
              body.solid.is_updated())
            findings.mistake(
                "Body " + body.name + "/Solid/Formulation",
                "bodies that touch others are 'total Lagrangian'.");
    }
  } // namespace


  void
  check_drives(const Scene &scene, Findings &findings)
  {
    for (const PlateBody &plate : scene.plate_bodies)
      {
        check_motion_entries(plate, findings);
        check_needed(plate, findings);
        check_response(plate, findings);
      }
    check_jaw(scene, findings);
    check_plate_pairs(scene, findings);
    check_food_pairs(scene, findings);
  }
} // namespace Morsel::Scene
