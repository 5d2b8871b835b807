#include <morsel/core/errors.h>
#include <morsel/core/expression.h>
#include <morsel/core/number_list.h>
#include <morsel/core/sentences.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>

#include <algorithm>

namespace Morsel::Scene
{
  namespace
  {
    const ParticleBody *
    find_body(const std::string &name,
              const std::string &path,
              const Scene       &scene,
              Findings          &findings)
    {
      std::vector<std::string> names;
      for (const ParticleBody &body : scene.particle_bodies)
        {
          if (body.name == name)
            return &body;
          names.push_back(body.name);
        }
      findings.mistake(path,
                       "there is no particle body '" + name + "'." +
                           did_you_mean(name, names));
      return nullptr;
    }


    void
    check_expression(const std::string &text,
                     const std::string &path,
                     Findings          &findings)
    {
      try
        {
          const VectorExpression expression(text);
        }
      catch (const InputError &error)
        {
          findings.mistake(path, as_sentence(error.what()));
        }
    }


    void
    check_numbers(const std::string &text,
                  const unsigned int n,
                  const std::string &path,
                  Findings          &findings)
    {
      try
        {
          number_list(text, n);
        }
      catch (const InputError &error)
        {
          findings.mistake(path, error.what());
        }
    }


    /// The names of some sides; of many the first ones.
    std::string
    sides_text(std::vector<std::string> sides)
    {
      constexpr unsigned int most = 8;
      if (sides.size() <= most)
        return quoted_list(sides);
      const std::string last = sides.back();
      sides.resize(most);
      return quoted_list(sides) + " or one of the others up to '" + last + "'";
    }


    void
    check_condition(const Condition &condition,
                    const Scene     &scene,
                    Findings        &findings)
    {
      const std::string         section = "Condition " + condition.name + "/";
      const ParticleBody *const body =
          find_body(condition.body, section + "Body", scene, findings);
      if (body == nullptr)
        return;
      check_expression(condition.value, section + "Value", findings);

      const Outline outline = body->shape.outline();
      const auto   &sides   = outline.get_side_names();
      if (condition.on_side() &&
          outline.side_named(condition.where) == sides.size())
        findings.mistake(section + "Where",
                         "'" + body->name + "' has no such side; give " +
                             sides_text(sides) + ", 'box' or 'everywhere'." +
                             did_you_mean(condition.where, sides));
      if ((condition.kind == "traction" || condition.kind == "pressure" ||
           condition.kind == "roller") &&
          !condition.on_side())
        findings.mistake(section + "Where",
                         "a " + condition.kind + " acts on a side; give " +
                             sides_text(sides) + ".");
      if (condition.where == "box" && !condition.has_box())
        findings.mistake(section + "Upper corner",
                         "the box has no extent; its upper corner must lie "
                         "above the lower one in x and y.");
      // Other fillings are known only once they are made.
      if (condition.has_box() && body->is_plain_lattice())
        {
          const auto points = body->positions(scene.seed);
          if (std::none_of(
                  points.begin(), points.end(), [&](const dealii::Point<2> &x) {
                    return condition.box.contains(x);
                  }))
            findings.mistake(section + "Lower corner",
                             "the box holds no particle of '" + body->name +
                                 "' (they stand " + number_text(body->spacing) +
                                 " m apart, the first one half of it inside).");
        }
    }


    void
    check_observer(const Observer &observer,
                   const Scene    &scene,
                   Findings       &findings)
    {
      const std::string         section = "Observer " + observer.name + "/";
      const ParticleBody *const body =
          find_body(observer.body, section + "Body", scene, findings);
      if (body == nullptr)
        return;
      const Outline outline = body->shape.outline();
      if (!outline.contains(observer.point) &&
          outline.distance(observer.point) > 0.1 * body->spacing)
        findings.mistake(section + "Point",
                         "it lies outside of the body '" + body->name + "'.");
      check_numbers(observer.expected_displacement,
                    2,
                    section + "Expected displacement",
                    findings);
      check_numbers(
          observer.expected_stress, 3, section + "Expected stress", findings);
    }
  } // namespace


  void
  check_conditions(const Scene &scene, Findings &findings)
  {
    if (!scene.plate_bodies.empty())
      if (!scene.observers.empty())
        findings.mistake("Observers",
                         "points are observed in scenes without plates; "
                         "leave out the rigid bodies, or these.");
    for (const Condition &condition : scene.conditions)
      check_condition(condition, scene, findings);
    for (const Observer &observer : scene.observers)
      check_observer(observer, scene, findings);
    for (const ParticleBody &body : scene.particle_bodies)
      {
        const std::string exclusion =
            "Body " + body.name + "/Damage/Face exclusion";
        if (scene.plate_bodies.empty() && body.damage.enabled &&
            findings.is_given(exclusion))
          findings.advise(exclusion,
                          "it acts under plates alone, and there are none.");
        const std::string section = "Body " + body.name + "/Particles/";
        if (!body.initial_velocity_field.empty())
          check_expression(body.initial_velocity_field,
                           section + "Initial velocity field",
                           findings);
        if (!body.expected_displacement_field.empty())
          check_expression(body.expected_displacement_field,
                           section + "Expected displacement field",
                           findings);
        check_numbers(
            body.initial_stress, 3, section + "Initial stress", findings);
        check_numbers(body.expected_velocity_gradient,
                      4,
                      section + "Expected velocity gradient",
                      findings);
      }
  }
} // namespace Morsel::Scene
