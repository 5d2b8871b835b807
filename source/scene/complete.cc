#include <morsel/core/errors.h>
#include <morsel/core/sentences.h>
#include <morsel/core/suggestions.h>
#include <morsel/materials/catalogue.h>
#include <morsel/scene/complete.h>
#include <morsel/scene/mass_scaling.h>
#include <morsel/scene/outline.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>

namespace Morsel::Scene
{
  namespace
  {
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
      for (const PlateBody &body : scene.plate_bodies)
        enclose(body.shape);
      const dealii::Tensor<1, 2> margin = 0.5 * (upper - lower);
      return {lower - margin, upper + margin};
    }


    /// @param path of the entry that says most of the shape
    /// @param complete does it, given the folder of the scene's file
    void
    complete_shape(const std::string                              &path,
                   const std::string                              &file_name,
                   const std::vector<ParameterEntry>              &entries,
                   const std::function<void(const std::string &)> &complete)
    {
      try
        {
          complete(std::filesystem::path(file_name).parent_path().string());
        }
      catch (const InputError &error)
        {
          const std::string where = last_place(entries, path);
          throw InputError((where.empty() ? file_name : where) + ": '" + path +
                           "' = '" + last_value(entries, path, "") +
                           "': " + as_sentence(error.what()));
        }
    }


    /// Material and damage, from the catalogue or with the defaults.
    void
    complete_solid(ParticleBody                      &body,
                   const std::vector<ParameterEntry> &entries)
    {
      Materials::MaterialParameters &material = body.material;
      const std::string path = "Body " + body.name + "/Material/Name";
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
          Materials::complete(body.damage, entry);
        }
      else
        Materials::complete(body.damage, nullptr);
      Materials::derive_strength(material);
    }


    /// A measured motion, and the full path of its file.
    void
    complete_table(PlateBody                         &body,
                   const std::string                 &file_name,
                   const std::vector<ParameterEntry> &entries)
    {
      std::string &table = body.motion.table_file;
      if (body.motion.kind != "table" || table.empty())
        return;
      const std::string path = "Body " + body.name + "/Motion/Table file";
      try
        {
          table = std::filesystem::absolute(
                      std::filesystem::path(file_name).parent_path() / table)
                      .lexically_normal()
                      .string();
          body.motion.table = Jaw::read_motion_table(table);
        }
      catch (const InputError &error)
        {
          throw InputError(last_place(entries, path) + ": '" + path + "' = '" +
                           last_value(entries, path, "") +
                           "': " + as_sentence(error.what()));
        }
    }


    /// All that may touch where a scene names no pairs.
    void
    pair_all(Scene &scene)
    {
      // Without plates bodies know nothing of each other.
      if (scene.plate_bodies.empty())
        return;
      for (const ParticleBody &food : scene.particle_bodies)
        for (const PlateBody &plate : scene.plate_bodies)
          scene.contact_pairs.push_back({food.name, plate.name});
      for (std::size_t i = 0; i < scene.particle_bodies.size(); ++i)
        for (std::size_t j = i + 1; j < scene.particle_bodies.size(); ++j)
          scene.food_pairs.push_back(
              {scene.particle_bodies[i].name, scene.particle_bodies[j].name});
      for (std::size_t i = 0; i < scene.plate_bodies.size(); ++i)
        for (std::size_t j = i + 1; j < scene.plate_bodies.size(); ++j)
          {
            const PlateBody &a = scene.plate_bodies[i];
            const PlateBody &b = scene.plate_bodies[j];
            const bool       together =
                a.motion.kind == "jaw" && b.motion.kind == "jaw";
            if (!together &&
                !(a.motion.is_prescribed() && b.motion.is_prescribed()))
              scene.plate_pairs.push_back({a.name, b.name});
          }
    }


    /// Reads "food:plate, tooth:tooth, food:food, ..."; the order within a pair
    /// is free.
    void
    read_pairs(const std::string                 &text,
               Scene                             &scene,
               const std::vector<ParameterEntry> &entries)
    {
      if (text.empty())
        {
          pair_all(scene);
          return;
        }
      std::set<std::string>    particle_names;
      std::vector<std::string> all_names;
      for (const ParticleBody &body : scene.particle_bodies)
        {
          particle_names.insert(body.name);
          all_names.push_back(body.name);
        }
      for (const PlateBody &body : scene.plate_bodies)
        all_names.push_back(body.name);

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
            if (std::find(all_names.begin(), all_names.end(), name) ==
                all_names.end())
              throw InputError(place + "There is no body '" + name + "'." +
                               did_you_mean(name, all_names));
          const unsigned int n_particle =
              particle_names.count(names[0]) + particle_names.count(names[1]);
          if (names[0] == names[1])
            throw InputError(place + "'" + item +
                             "' must join two different bodies.");
          if (n_particle == 2)
            scene.food_pairs.push_back({names[0], names[1]});
          else if (n_particle == 0)
            scene.plate_pairs.push_back({names[0], names[1]});
          else if (particle_names.count(names[0]) > 0)
            scene.contact_pairs.push_back({names[0], names[1]});
          else
            scene.contact_pairs.push_back({names[1], names[0]});
        }
    }


    /// The ways of approach in metres, from their shares; plates that close
    /// from two sides share the closure by their speeds.
    void
    complete_approaches(Scene &scene)
    {
      const auto food = std::find_if(
          scene.particle_bodies.begin(),
          scene.particle_bodies.end(),
          [](const ParticleBody &body) { return body.damage.enabled; });
      if (food == scene.particle_bodies.end())
        return;
      for (PlateBody &plate : scene.plate_bodies)
        {
          if (plate.motion.kind != "constant")
            continue;
          const auto        &v     = plate.motion.velocity;
          const unsigned int axis  = std::abs(v[0]) > std::abs(v[1]) ? 0 : 1;
          double             speed = 0.;
          for (const PlateBody &other : scene.plate_bodies)
            speed += std::abs(other.motion.velocity[axis]);
          if (speed > 0.)
            plate.motion.approach = plate.motion.approach_share *
                                    expected_failure_closure(*food, axis) *
                                    v.norm() / speed;
        }
    }
  } // namespace


  double
  expected_failure_closure(const ParticleBody &body, const unsigned int axis)
  {
    const double nu = body.material.poissons_ratio;
    return body.material.compressive_strength * (1. - nu * nu) /
           body.material.youngs_modulus * body.shape.extent(axis);
  }


  void
  complete_scene(Scene                             &scene,
                 const std::string                 &pairs,
                 const std::string                 &file_name,
                 const std::vector<ParameterEntry> &entries)
  {
    if (scene.name.empty())
      scene.name = std::filesystem::path(file_name).stem().string();
    for (ParticleBody &body : scene.particle_bodies)
      complete_shape("Body " + body.name + "/Shape/" + body.shape.main_entry(),
                     file_name,
                     entries,
                     [&](const std::string &folder) {
                       body.shape.complete(body.particles_across, folder);
                     });
    for (PlateBody &body : scene.plate_bodies)
      {
        complete_shape(
            "Body " + body.name + "/Shape/Mesh file",
            file_name,
            entries,
            [&](const std::string &folder) { body.shape.complete(folder); });
        complete_table(body, file_name, entries);
      }
    if (last_place(entries, "Domain/Lower corner").empty() &&
        last_place(entries, "Domain/Upper corner").empty())
      scene.domain = box_around_bodies(scene);
    for (ParticleBody &body : scene.particle_bodies)
      {
        if (body.particles_across > 0)
          body.spacing = body.shape.extent(0) / body.particles_across;
        complete_solid(body, entries);
      }
    complete_approaches(scene);
    scene.time.inertia_factor = inertia_factor(scene);
    read_pairs(pairs, scene, entries);
    if (scene.particle_bodies.empty())
      return;
    const std::string first = scene.particle_bodies.front().name;
    for (Condition &condition : scene.conditions)
      if (condition.body.empty())
        condition.body = first;
    for (Observer &observer : scene.observers)
      if (observer.body.empty())
        observer.body = first;
  }
} // namespace Morsel::Scene
