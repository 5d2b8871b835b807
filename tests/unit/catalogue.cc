// The catalogue of foods and rocks.
#include <morsel/core/errors.h>
#include <morsel/materials/catalogue.h>

#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace Morsel::Materials;

BOOST_AUTO_TEST_SUITE(catalogue)

BOOST_AUTO_TEST_CASE(every_entry_is_sound_and_names_its_source)
{
  const Catalogue catalogue(Catalogue::shipped_file());
  BOOST_TEST(catalogue.entries().size() == 13u);
  for (const CatalogueEntry &entry : catalogue.entries())
    BOOST_TEST_CONTEXT(entry.name)
    {
      BOOST_TEST(!entry.source.empty());
      BOOST_TEST((entry.kind == "food" || entry.kind == "rock"));
      BOOST_TEST(entry.density > 800.);
      BOOST_TEST(entry.youngs_modulus > 1e6);
      BOOST_TEST(entry.poissons_ratio > 0.);
      BOOST_TEST(entry.poissons_ratio < 0.5);
      BOOST_TEST((entry.toughness > 0. || entry.compressive_strength > 0.));
      for (const std::string &name : entry.assumed)
        BOOST_TEST((name == "density" || name == "youngs_modulus" ||
                    name == "poissons_ratio" || name == "toughness" ||
                    name == "fracture_energy" ||
                    name == "compressive_strength"));
      if (!entry.damage)
        continue;
      BOOST_TEST(std::filesystem::is_regular_file(MORSEL_SOURCE_DIR "/" +
                                                  entry.damage->scene));
      BOOST_TEST(entry.damage->particles_across > 0u);
      BOOST_TEST(entry.damage->seeds > 0u);
      const double c = entry.damage->threshold_factor.value_or(0.);
      BOOST_TEST((c > 0.1 && c < 10.));
    }
}


BOOST_AUTO_TEST_CASE(open_damage_is_the_catalogues_or_else_the_default)
{
  const DamageParameters defaults;
  DamageParameters       damage = DamageParameters::left_open();
  complete(damage, nullptr);
  BOOST_TEST(damage.threshold_factor == defaults.threshold_factor);
  BOOST_TEST(damage.weibull_modulus == defaults.weibull_modulus);
  BOOST_TEST(damage.strength_ratio == defaults.strength_ratio);
  BOOST_TEST(damage.fracture_energy == defaults.fracture_energy);
  BOOST_TEST(damage.correlation_length == defaults.correlation_length);
  BOOST_TEST(damage.flaws == defaults.flaws);

  CatalogueEntry entry;
  entry.damage.emplace();
  entry.damage->threshold_factor = 1.05;
  entry.damage->fracture_energy  = 2.5;
  entry.damage->flaws            = "correlated";
  damage                         = DamageParameters::left_open();
  damage.weibull_modulus         = 5.;
  complete(damage, &entry);
  BOOST_TEST(damage.threshold_factor == 1.05);
  BOOST_TEST(damage.fracture_energy == 2.5);
  BOOST_TEST(damage.flaws == "correlated");
  BOOST_TEST(damage.weibull_modulus == 5.);
  BOOST_TEST(damage.strength_ratio == defaults.strength_ratio);

  // What the scene gives goes before, 0 for the fracture energy included.
  damage                  = DamageParameters::left_open();
  damage.fracture_energy  = 0.;
  damage.threshold_factor = 1.3;
  damage.flaws            = "uniform";
  complete(damage, &entry);
  BOOST_TEST(damage.fracture_energy == 0.);
  BOOST_TEST(damage.threshold_factor == 1.3);
  BOOST_TEST(damage.flaws == "uniform");

  // Grady-Kipp growth has no fracture energy.
  damage        = DamageParameters::left_open();
  damage.growth = "Grady-Kipp";
  complete(damage, &entry);
  BOOST_TEST(damage.fracture_energy == 0.);
}


BOOST_AUTO_TEST_CASE(calibrated_damage_is_read_as_it_was_written)
{
  CatalogueDamage damage;
  damage.threshold_factor = 1.05;
  damage.flaws            = "Weibull";
  damage.scene            = "prm/food/peanut.prm";
  damage.particles_across = 41;
  damage.seeds            = 5;
  const auto file         = std::filesystem::temp_directory_path() /
                    ("morsel_catalogue" + std::to_string(getpid()) + ".json");
  nlohmann::ordered_json catalogue =
      nlohmann::ordered_json::parse(std::ifstream(Catalogue::shipped_file()));
  catalogue["materials"][0]["damage"] = as_json(damage);
  std::ofstream(file) << catalogue;
  const Catalogue read(file.string());
  std::filesystem::remove(file);
  const auto &found = read.entries().front().damage;
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(*found->threshold_factor == 1.05);
  BOOST_TEST(*found->flaws == "Weibull");
  BOOST_TEST(!found->strength_ratio.has_value());
  BOOST_TEST(found->scene == "prm/food/peanut.prm");
  BOOST_TEST(found->particles_across == 41u);
  BOOST_TEST(found->seeds == 5u);
}


BOOST_AUTO_TEST_CASE(strengths_of_the_foods_are_those_of_the_literature)
{
  const Catalogue catalogue(Catalogue::shipped_file());
  const auto      strength = [&](const std::string &name) {
    MaterialParameters material;
    BOOST_REQUIRE(catalogue.find(name) != nullptr);
    complete(material, *catalogue.find(name));
    derive_strength(material);
    return material.compressive_strength;
  };
  BOOST_TEST(std::abs(strength("almond") - 103.0e3) < 50.);
  BOOST_TEST(std::abs(strength("raw carrot") - 63.4e3) < 50.);
  BOOST_TEST(std::abs(strength("roasted peanut") - 101.2e3) < 50.);
  BOOST_TEST(strength("basalt") == 352.6e6);
  BOOST_TEST(catalogue.find("Basalt") == nullptr);
}


BOOST_AUTO_TEST_CASE(fracture_energies_stand_where_they_are_known)
{
  const Catalogue catalogue(Catalogue::shipped_file());
  BOOST_TEST(catalogue.find("starch pet food")->fracture_energy == 1500.);
  BOOST_TEST(catalogue.find("almond")->fracture_energy == 0.);
  // K^2/E of the raw carrot: K is 30 kPa sqrt(m).
  const CatalogueEntry &carrot = *catalogue.find("raw carrot");
  BOOST_TEST(carrot.fracture_energy * carrot.youngs_modulus == 9e8,
             boost::test_tools::tolerance(0.02));
}


BOOST_AUTO_TEST_CASE(what_is_given_goes_before_the_catalogue)
{
  const Catalogue    catalogue(Catalogue::shipped_file());
  MaterialParameters material;
  material.density        = 1.;
  material.poissons_ratio = 0.;
  material.toughness      = 2.;
  complete(material, *catalogue.find("basalt"));
  derive_strength(material);
  BOOST_TEST(material.density == 1.);
  BOOST_TEST(material.poissons_ratio == 0.);
  BOOST_TEST(material.youngs_modulus == 95.2e9);
  BOOST_TEST(material.compressive_strength == std::sqrt(4. * 95.2e9));
}


BOOST_AUTO_TEST_CASE(a_missing_catalogue_is_a_failure_of_files)
{
  BOOST_CHECK_THROW(Catalogue("/nowhere/materials.json"), Morsel::FileError);
}

BOOST_AUTO_TEST_SUITE_END()
