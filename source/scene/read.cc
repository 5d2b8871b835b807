#include <morsel/core/failure.h>
#include <morsel/core/parameters.h>
#include <morsel/scene/check.h>
#include <morsel/scene/complete.h>
#include <morsel/scene/lists.h>
#include <morsel/scene/read.h>
#include <morsel/scene/write_back.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace Morsel::Scene
{
  namespace
  {
    namespace Patterns = dealii::Patterns;


    /// Second pass: the scene's members bound to their entries. The scene must
    /// stay where it is while the handler is in use.
    class Declaration
    {
    public:
      /// @param with_calibration whether there is a section "Calibration",
      ///   which is no part of a run.
      Declaration(const NamedParts &parts, bool with_calibration);

      Scene                            scene;
      std::string                      pairs;
      Calibrate::CalibrationParameters calibration;
      dealii::ParameterHandler         prm;

    private:
      void
      declare_body(const NamedBody &body);

      /// A list of names and a section for each.
      template <typename Part>
      void
      declare_named(const std::vector<std::string> &given,
                    std::vector<std::string>       &bound,
                    std::vector<Part>              &parts,
                    const std::string              &thing,
                    const std::string              &meaning);

      std::vector<std::string> body_names, condition_names, observer_names,
          muscle_names;
    };


    Declaration::Declaration(const NamedParts &parts,
                             const bool        with_calibration)
    {
      const std::vector<NamedBody> &bodies = parts.bodies;
      for (const NamedBody &body : bodies)
        {
          body_names.push_back(body.name);
          if (body.kind == "rigid" || body.kind == "elastic")
            {
              scene.plate_bodies.emplace_back();
              scene.plate_bodies.back().name = body.name;
              scene.plate_bodies.back().deformation.elastic =
                  body.kind == "elastic";
            }
          else
            {
              scene.particle_bodies.emplace_back();
              scene.particle_bodies.back().name = body.name;
            }
        }

      prm.add_parameter("Name",
                        scene.name,
                        "Name of the scene and of its folder of results; the "
                        "scene file's name if empty.");
      prm.add_parameter("Title", scene.title, "What the scene shows.");
      prm.add_parameter("Depth",
                        scene.depth,
                        "Extent out of the plane [m]; forces and energies are "
                        "for this depth.",
                        Patterns::Double());
      prm.add_parameter("Seed",
                        scene.seed,
                        "Seed of all random numbers: the same seed, the same "
                        "flaws [1].",
                        Patterns::Integer(0));
      prm.add_parameter("Bodies",
                        body_names,
                        "Names of the bodies; each has a section 'Body "
                        "<name>'.",
                        Patterns::List(Patterns::Anything(), 1));

      prm.enter_subsection("Domain");
      scene.domain.declare(prm);
      prm.leave_subsection();

      for (const NamedBody &body : bodies)
        declare_body(body);

      prm.enter_subsection("Contact");
      prm.add_parameter("Pairs",
                        pairs,
                        "Bodies that may touch, as 'food:plate, "
                        "food:food, tooth:tooth'; if empty, every particle "
                        "body with every other body, and rigid or elastic "
                        "ones that a force or the jaw moves with all others. "
                        "Of account where there are plates.");
      scene.contact.declare(prm);
      prm.leave_subsection();

      declare_named(parts.conditions,
                    condition_names,
                    scene.conditions,
                    "Condition",
                    "Names of the supports and loads of particle bodies");
      declare_named(parts.observers,
                    observer_names,
                    scene.observers,
                    "Observer",
                    "Names of the points that are recorded in a scene without "
                    "plates");

      declare_named(parts.muscles,
                    muscle_names,
                    scene.muscles,
                    "Muscle",
                    "Names of the muscles that move the jaw");

      const auto section = [this](const char *name, auto &part) {
        prm.enter_subsection(name);
        part.declare(prm);
        prm.leave_subsection();
      };
      section("Jaw", scene.jaw);
      section("Time", scene.time);
      section("Stop", scene.stop);
      section("Output", scene.output);
      section("Measures", scene.measures);
      section("Ranks", scene.ranks);
      if (with_calibration)
        section("Calibration", calibration);
    }


    template <typename Part>
    void
    Declaration::declare_named(const std::vector<std::string> &given,
                               std::vector<std::string>       &bound,
                               std::vector<Part>              &parts,
                               const std::string              &thing,
                               const std::string              &meaning)
    {
      bound = given;
      prm.add_parameter(thing + "s",
                        bound,
                        meaning + "; each has a section '" + thing +
                            " <name>'.",
                        Patterns::List(Patterns::Anything()));
      parts.resize(given.size());
      for (unsigned int k = 0; k < given.size(); ++k)
        {
          parts[k].name = given[k];
          prm.enter_subsection(thing + " " + given[k]);
          parts[k].declare(prm);
          prm.leave_subsection();
        }
    }


    void
    Declaration::declare_body(const NamedBody &body)
    {
      prm.enter_subsection("Body " + body.name);
      prm.declare_entry(
          "Kind",
          body.kind,
          Patterns::Selection("particles|rigid|elastic"),
          "'particles' (a deformable solid that can break), "
          "'rigid' (moves by its drive) or 'elastic' (finite elements, "
          "held at sides that move so).");
      for (ParticleBody &particles : scene.particle_bodies)
        if (particles.name == body.name)
          particles.declare(prm);
      for (PlateBody &rigid : scene.plate_bodies)
        if (rigid.name == body.name)
          rigid.declare(prm);
      prm.leave_subsection();
    }


    std::vector<ParameterEntry>
    read_entries(const std::string              &file_name,
                 const std::vector<std::string> &overrides)
    {
      std::vector<ParameterEntry> entries = read_parameter_file(file_name);
      for (const std::string &text : overrides)
        entries.push_back(read_override(text));
      return entries;
    }


    /// Checks all entries against their patterns.
    Calibrate::CalibrationParameters
    calibration_of(const NamedParts                  &parts,
                   const std::vector<ParameterEntry> &entries)
    {
      Declaration declaration(parts, true);
      set_parameters(declaration.prm, entries);
      return declaration.calibration;
    }


    /// What a run depends on.
    std::vector<ParameterEntry>
    without_calibration(std::vector<ParameterEntry> entries)
    {
      entries.erase(std::remove_if(entries.begin(),
                                   entries.end(),
                                   [](const ParameterEntry &entry) {
                                     return entry.section == "Calibration";
                                   }),
                    entries.end());
      return entries;
    }
  } // namespace


  Scene
  read_scene(const std::string              &file_name,
             const std::vector<std::string> &overrides)
  {
    const std::vector<ParameterEntry> entries =
        read_entries(file_name, overrides);
    const NamedParts parts = list_parts(file_name, entries);
    calibration_of(parts, entries);
    Declaration declaration(parts, false);
    set_parameters(declaration.prm, without_calibration(entries));
    complete_scene(declaration.scene, declaration.pairs, file_name, entries);

    Scene &scene   = declaration.scene;
    scene.warnings = check_scene(scene, entries, file_name);

    write_back(declaration.scene, declaration.prm);
    scene.used_parameters = parameters_as_prm(declaration.prm, false);
    scene.parameters_hash = text_hash(scene.used_parameters);
    return scene;
  }


  Scene
  read_scene_on_all_ranks(const std::string              &file_name,
                          const std::vector<std::string> &overrides)
  {
    const FirstRank first_rank;
    Scene           scene;
    first_rank.run([&] { scene = read_scene(file_name, overrides); });
    return first_rank.is_this_rank() ? scene : read_scene(file_name, overrides);
  }


  Calibrate::CalibrationParameters
  read_calibration(const std::string              &file_name,
                   const std::vector<std::string> &overrides)
  {
    const std::vector<ParameterEntry> entries =
        read_entries(file_name, overrides);
    return calibration_of(list_parts(file_name, entries), entries);
  }


  std::string
  print_parameters(const ParameterFormat           format,
                   const std::string              &file_name,
                   const std::vector<std::string> &overrides)
  {
    const bool                        of_a_scene = !file_name.empty();
    const std::vector<ParameterEntry> entries =
        of_a_scene ? read_entries(file_name, overrides)
                   : std::vector<ParameterEntry>();
    NamedParts parts;
    if (of_a_scene)
      parts = list_parts(file_name, entries);
    else
      {
        parts.bodies = {
            {"food", "particles"}, {"plate", "rigid"}, {"tooth", "elastic"}};
        parts.conditions = {"load"};
        parts.observers  = {"tip"};
        parts.muscles    = {"masseter"};
      }
    Declaration declaration(parts, true);
    if (of_a_scene)
      {
        set_parameters(declaration.prm, entries);
        complete_scene(
            declaration.scene, declaration.pairs, file_name, entries);
        check_scene(declaration.scene, entries, file_name);
        write_back(declaration.scene, declaration.prm);
      }
    switch (format)
      {
        case ParameterFormat::json:
          return parameters_as_json(declaration.prm);
        case ParameterFormat::markdown:
          return parameters_as_markdown(declaration.prm);
        default:
          return parameters_as_prm(declaration.prm, true);
      }
  }
} // namespace Morsel::Scene
