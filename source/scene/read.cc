#include <morsel/core/errors.h>
#include <morsel/core/parameters.h>
#include <morsel/core/suggestions.h>
#include <morsel/materials/catalogue.h>
#include <morsel/scene/check.h>
#include <morsel/scene/read.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

namespace Morsel::Scene
{
  namespace
  {
    namespace Patterns = dealii::Patterns;


    struct NamedBody
    {
      std::string name;
      std::string kind;
    };


    /// First pass: the list of bodies, and the kind of each, on which depends
    /// which other entries there are.
    std::vector<NamedBody>
    list_bodies(const std::string                 &file_name,
                const std::vector<ParameterEntry> &entries)
    {
      const std::string list  = last_value(entries, "Bodies", "");
      const std::string place = last_place(entries, "Bodies");
      if (list.empty())
        throw InputError((place.empty() ? file_name : place) +
                         ": The scene has no bodies; name them, as in 'set "
                         "Bodies = food, lower plate, upper plate'.");

      std::vector<NamedBody> bodies;
      std::set<std::string>  names;
      for (const std::string &name :
           dealii::Utilities::split_string_list(list, ','))
        {
          if (name.empty() || name.find_first_of(":/\"") != std::string::npos)
            throw InputError(place + ": 'Bodies' = '" + list +
                             "' is not allowed: a body's name is not empty "
                             "and has no ':', '/' or '\"'.");
          if (!names.insert(name).second)
            throw InputError(place + ": 'Bodies' names '" + name + "' twice.");

          const std::string path = "Body " + name + "/Kind";
          const std::string kind = last_value(entries, path, "particles");
          if (kind != "particles" && kind != "rigid")
            throw InputError(last_place(entries, path) + ": '" + path +
                             "' = '" + kind +
                             "' is not allowed: give 'particles' or 'rigid'." +
                             did_you_mean(kind, {"particles", "rigid"}));
          bodies.push_back({name, kind});
        }

      // A section of a body that is not listed is most likely a misspelt name.
      for (const ParameterEntry &entry : entries)
        {
          const std::string section =
              entry.section.substr(0, entry.section.find('/'));
          if (section.rfind("Body ", 0) == 0 &&
              names.count(section.substr(5)) == 0)
            throw InputError(
                entry.where + ": The section '" + section +
                "' is of a body that is not in 'Bodies' (" + list + ")." +
                did_you_mean(section.substr(5), {names.begin(), names.end()}));
        }
      return bodies;
    }


    /// Second pass: the scene's members bound to their entries. The scene must
    /// stay where it is while the handler is in use.
    class Declaration
    {
    public:
      explicit Declaration(const std::vector<NamedBody> &bodies);

      /// Writes derived values back, so that the printed parameters
      /// reproduce the run.
      void
      write_back();

      Scene                    scene;
      std::string              pairs;
      dealii::ParameterHandler prm;

    private:
      void
      declare_body(const NamedBody &body);

      std::vector<std::string> body_names;
    };


    Declaration::Declaration(const std::vector<NamedBody> &bodies)
    {
      for (const NamedBody &body : bodies)
        {
          body_names.push_back(body.name);
          if (body.kind == "rigid")
            {
              scene.rigid_bodies.emplace_back();
              scene.rigid_bodies.back().name = body.name;
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
                        "Bodies that may touch, as 'food:plate, ...'; every "
                        "particle body with every rigid one if empty.");
      scene.contact.declare(prm);
      prm.leave_subsection();

      const auto section = [this](const char *name, auto &part) {
        prm.enter_subsection(name);
        part.declare(prm);
        prm.leave_subsection();
      };
      section("Time", scene.time);
      section("Stop", scene.stop);
      section("Output", scene.output);
      section("Measures", scene.measures);
    }


    void
    Declaration::declare_body(const NamedBody &body)
    {
      prm.enter_subsection("Body " + body.name);
      prm.declare_entry("Kind",
                        body.kind == "rigid" ? "rigid" : "particles",
                        Patterns::Selection("particles|rigid"),
                        "'particles' (a deformable solid that can break) or "
                        "'rigid' (moves as told).");
      for (ParticleBody &particles : scene.particle_bodies)
        if (particles.name == body.name)
          particles.declare(prm);
      for (RigidBody &rigid : scene.rigid_bodies)
        if (rigid.name == body.name)
          rigid.declare(prm);
      prm.leave_subsection();
    }


    /// All digits that a number needs to be read back unchanged.
    std::string
    exact_text(const double value)
    {
      std::ostringstream text;
      text.precision(15);
      text << value;
      if (std::stod(text.str()) != value)
        {
          text.str("");
          text.precision(17);
          text << value;
        }
      return text.str();
    }


    void
    Declaration::write_back()
    {
      prm.set("Name", scene.name);
      const auto point_text = [](const dealii::Point<2> &p) {
        return exact_text(p[0]) + ", " + exact_text(p[1]);
      };
      prm.enter_subsection("Domain");
      prm.set("Lower corner", point_text(scene.domain.lower_corner));
      prm.set("Upper corner", point_text(scene.domain.upper_corner));
      prm.leave_subsection();

      for (const ParticleBody &body : scene.particle_bodies)
        {
          // A copy, since setting an entry sets the bound member, too.
          const Materials::MaterialParameters material = body.material;
          prm.enter_subsection("Body " + body.name);
          prm.enter_subsection("Material");
          prm.set("Density", exact_text(material.density));
          prm.set("Young's modulus", exact_text(material.youngs_modulus));
          prm.set("Poisson's ratio", exact_text(material.poissons_ratio));
          prm.set("Toughness", exact_text(material.toughness));
          prm.set("Compressive strength",
                  exact_text(material.compressive_strength));
          prm.leave_subsection();
          prm.leave_subsection();
        }

      std::string list;
      for (const ContactPair &pair : scene.contact_pairs)
        list += (list.empty() ? "" : ", ") + pair.food + ":" + pair.plate;
      prm.enter_subsection("Contact");
      prm.set("Pairs", list);
      prm.leave_subsection();
    }


    /// The bodies' bounding box with a margin of half its size, for a scene
    /// that names no domain.
    Rectangle
    box_around_bodies(const Scene &scene)
    {
      const double     infinity = std::numeric_limits<double>::infinity();
      dealii::Point<2> lower(infinity, infinity), upper(-infinity, -infinity);
      const auto       enclose = [&](const Rectangle &shape) {
        for (unsigned int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], shape.lower_corner[d]);
            upper[d] = std::max(upper[d], shape.upper_corner[d]);
          }
      };
      for (const ParticleBody &body : scene.particle_bodies)
        enclose(body.shape);
      for (const RigidBody &body : scene.rigid_bodies)
        enclose(body.shape);
      const dealii::Tensor<1, 2> margin = 0.5 * (upper - lower);
      return {lower - margin, upper + margin};
    }


    void
    complete_material(Materials::MaterialParameters     &material,
                      const std::string                 &path,
                      const std::vector<ParameterEntry> &entries)
    {
      if (material.name != "inline")
        {
          const Materials::Catalogue catalogue(
              Materials::Catalogue::shipped_file());
          const Materials::CatalogueEntry *const entry =
              catalogue.find(material.name);
          if (entry == nullptr)
            {
              const std::string suggestion =
                  did_you_mean(material.name, catalogue.names());
              throw InputError(
                  last_place(entries, path) + ": '" + path + "' = '" +
                  material.name + "' is not in the catalogue of materials." +
                  (suggestion.empty()
                       ? " There are " + quoted_list(catalogue.names()) +
                             "; or give 'inline' and every value."
                       : suggestion));
            }
          Materials::complete(material, *entry);
        }
      Materials::derive_strength(material);
    }


    /// Reads "food:plate, ..."; the order within a pair is free.
    std::vector<ContactPair>
    read_pairs(const std::string                 &text,
               const Scene                       &scene,
               const std::vector<ParameterEntry> &entries)
    {
      std::set<std::string> particle_names, rigid_names;
      for (const ParticleBody &body : scene.particle_bodies)
        particle_names.insert(body.name);
      for (const RigidBody &body : scene.rigid_bodies)
        rigid_names.insert(body.name);
      std::vector<std::string> all_names(particle_names.begin(),
                                         particle_names.end());
      all_names.insert(all_names.end(), rigid_names.begin(), rigid_names.end());

      std::vector<ContactPair> pairs;
      if (text.empty())
        for (const ParticleBody &food : scene.particle_bodies)
          for (const RigidBody &plate : scene.rigid_bodies)
            pairs.push_back({food.name, plate.name});

      const std::string place = last_place(entries, "Contact/Pairs") +
                                ": 'Contact/Pairs' = '" + text + "': ";
      for (const std::string &item :
           dealii::Utilities::split_string_list(text, ','))
        {
          const std::vector<std::string> names =
              dealii::Utilities::split_string_list(item, ':');
          if (names.size() != 2)
            throw InputError(place + "'" + item +
                             "' is not a pair; give 'food:plate'.");
          for (const std::string &name : names)
            if (particle_names.count(name) + rigid_names.count(name) == 0)
              throw InputError(place + "There is no body '" + name + "'." +
                               did_you_mean(name, all_names));
          const bool        in_order = particle_names.count(names[0]) > 0;
          const ContactPair pair{names[in_order ? 0 : 1],
                                 names[in_order ? 1 : 0]};
          if (particle_names.count(pair.food) == 0 ||
              rigid_names.count(pair.plate) == 0)
            throw InputError(place + "'" + item +
                             "' must join a particle body and a rigid one.");
          pairs.push_back(pair);
        }
      return pairs;
    }


    /// What follows from the entries: names, spacings, materials, pairs.
    void
    complete_scene(Declaration                       &declaration,
                   const std::string                 &file_name,
                   const std::vector<ParameterEntry> &entries)
    {
      Scene &scene = declaration.scene;
      if (scene.name.empty())
        scene.name = std::filesystem::path(file_name).stem().string();
      if (last_place(entries, "Domain/Lower corner").empty() &&
          last_place(entries, "Domain/Upper corner").empty())
        scene.domain = box_around_bodies(scene);
      for (ParticleBody &body : scene.particle_bodies)
        {
          if (body.particles_across > 0)
            body.spacing = body.shape.extent(0) / body.particles_across;
          complete_material(
              body.material, "Body " + body.name + "/Material/Name", entries);
        }
      scene.contact_pairs = read_pairs(declaration.pairs, scene, entries);
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
  } // namespace


  Scene
  read_scene(const std::string              &file_name,
             const std::vector<std::string> &overrides)
  {
    const std::vector<ParameterEntry> entries =
        read_entries(file_name, overrides);
    Declaration declaration(list_bodies(file_name, entries));
    set_parameters(declaration.prm, entries);
    complete_scene(declaration, file_name, entries);

    Scene &scene   = declaration.scene;
    scene.warnings = check_scene(scene, entries, file_name);

    declaration.write_back();
    scene.used_parameters = parameters_as_prm(declaration.prm, false);
    scene.parameters_hash = text_hash(scene.used_parameters);
    return scene;
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
    Declaration declaration(of_a_scene
                                ? list_bodies(file_name, entries)
                                : std::vector<NamedBody>{{"food", "particles"},
                                                         {"plate", "rigid"}});
    if (of_a_scene)
      {
        set_parameters(declaration.prm, entries);
        complete_scene(declaration, file_name, entries);
        check_scene(declaration.scene, entries, file_name);
        declaration.write_back();
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
