#include <morsel/core/data_files.h>
#include <morsel/core/errors.h>
#include <morsel/materials/catalogue.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace Morsel::Materials
{
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
  derive_strength(MaterialParameters &material)
  {
    if (material.compressive_strength == 0. && material.toughness > 0. &&
        material.youngs_modulus > 0.)
      material.compressive_strength =
          std::sqrt(2. * material.youngs_modulus * material.toughness);
  }
} // namespace Morsel::Materials
