// The catalogue of foods and rocks.
#include <morsel/core/errors.h>
#include <morsel/materials/catalogue.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

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
    }
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
