#include <morsel/core/data_files.h>
#include <morsel/core/errors.h>
#include <morsel/materials/catalogue.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace Morsel::Materials
{
  namespace
  {
    template <typename T>
    void
    get_optional(const nlohmann::json &object,
                 const char           *name,
                 std::optional<T>     &value)
    {
      if (object.contains(name))
        value = object.at(name).get<T>();
    }


    CatalogueDamage
    damage_of(const nlohmann::json &object)
    {
      CatalogueDamage damage;
      get_optional(object, "threshold_factor", damage.threshold_factor);
      get_optional(object, "weibull_modulus", damage.weibull_modulus);
      get_optional(object, "strength_ratio", damage.strength_ratio);
      get_optional(object, "fracture_energy", damage.fracture_energy);
      get_optional(object, "flaws", damage.flaws);
      get_optional(object, "correlation_length", damage.correlation_length);
      object.at("scene").get_to(damage.scene);
      object.at("particles_across").get_to(damage.particles_across);
      object.at("seeds").get_to(damage.seeds);
      return damage;
    }


    /// The value that is open, from the catalogue or else the default.
    template <typename T>
    void
    fill(T                      &value,
         const T                &open,
         const std::optional<T> &known,
         const T                &otherwise)
    {
      if (value == open)
        value = known.value_or(otherwise);
    }
  } // namespace


  nlohmann::ordered_json
  as_json(const CatalogueDamage &damage)
  {
    nlohmann::ordered_json json;
    const auto             set = [&](const char *name, const auto &value) {
      if (value)
        json[name] = *value;
    };
    set("threshold_factor", damage.threshold_factor);
    set("weibull_modulus", damage.weibull_modulus);
    set("strength_ratio", damage.strength_ratio);
    set("fracture_energy", damage.fracture_energy);
    set("flaws", damage.flaws);
    set("correlation_length", damage.correlation_length);
    json["scene"]            = damage.scene;
    json["particles_across"] = damage.particles_across;
    json["seeds"]            = damage.seeds;
    return json;
  }


  Catalogue::Catalogue(const std::string &file_name)
  {
    std::ifstream file(file_name);
    if (!file)
      throw FileError("The catalogue of materials '" + file_name +
                      "' cannot be read.");
    try
      {
        const nlohmann::json json = nlohmann::json::parse(file);
        for (const nlohmann::json &item : json.at("materials"))
          {
            CatalogueEntry entry;
            item.at("name").get_to(entry.name);
            item.at("kind").get_to(entry.kind);
            item.at("density").get_to(entry.density);
            item.at("youngs_modulus").get_to(entry.youngs_modulus);
            item.at("poissons_ratio").get_to(entry.poissons_ratio);
            item.at("toughness").get_to(entry.toughness);
            entry.fracture_energy = item.value("fracture_energy", 0.);
            item.at("compressive_strength").get_to(entry.compressive_strength);
            item.at("source").get_to(entry.source);
            item.at("assumed").get_to(entry.assumed);
            if (item.contains("damage"))
              entry.damage = damage_of(item.at("damage"));
            materials.push_back(entry);
          }
      }
    catch (const nlohmann::json::exception &error)
      {
        throw FileError("The catalogue of materials '" + file_name +
                        "' is not understood: " + error.what());
      }
  }


  std::string
  Catalogue::shipped_file()
  {
    return Morsel::shipped_file("materials.json");
  }


  const std::vector<CatalogueEntry> &
  Catalogue::entries() const
  {
    return materials;
  }


  std::vector<std::string>
  Catalogue::names() const
  {
    std::vector<std::string> result;
    for (const CatalogueEntry &entry : materials)
      result.push_back(entry.name);
    return result;
  }


  const CatalogueEntry *
  Catalogue::find(const std::string &name) const
  {
    for (const CatalogueEntry &entry : materials)
      if (entry.name == name)
        return &entry;
    return nullptr;
  }


  void
  complete(MaterialParameters &material, const CatalogueEntry &entry)
  {
    const auto fill = [](double &value, const double missing, double known) {
      if (value == missing)
        value = known;
    };
    fill(material.density, 0., entry.density);
    fill(material.youngs_modulus, 0., entry.youngs_modulus);
    fill(material.poissons_ratio, -1., entry.poissons_ratio);
    // A strength follows from the modulus and the toughness that hold, so the
    // catalogue's own strength goes only before its own toughness.
    const bool given_here =
        material.toughness > 0. || material.compressive_strength > 0.;
    fill(material.toughness, 0., entry.toughness);
    if (!given_here)
      fill(material.compressive_strength, 0., entry.compressive_strength);
  }


  void
  complete(DamageParameters &damage, const CatalogueEntry *entry)
  {
    const DamageParameters open = DamageParameters::left_open();
    const DamageParameters defaults;
    CatalogueDamage        known;
    if (entry != nullptr && entry->damage)
      known = *entry->damage;
    if (damage.growth == "Grady-Kipp")
      known.fracture_energy.reset();
    fill(damage.threshold_factor,
         open.threshold_factor,
         known.threshold_factor,
         defaults.threshold_factor);
    fill(damage.weibull_modulus,
         open.weibull_modulus,
         known.weibull_modulus,
         defaults.weibull_modulus);
    fill(damage.strength_ratio,
         open.strength_ratio,
         known.strength_ratio,
         defaults.strength_ratio);
    fill(damage.fracture_energy,
         open.fracture_energy,
         known.fracture_energy,
         defaults.fracture_energy);
    fill(damage.flaws, open.flaws, known.flaws, defaults.flaws);
    fill(damage.correlation_length,
         open.correlation_length,
         known.correlation_length,
         defaults.correlation_length);
  }


  void
  derive_strength(MaterialParameters &material)
  {
    if (material.compressive_strength == 0. && material.toughness > 0. &&
        material.youngs_modulus > 0.)
      material.compressive_strength =
          std::sqrt(2. * material.youngs_modulus * material.toughness);
  }
} // namespace Morsel::Materials
