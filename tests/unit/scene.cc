// Scenes: what the shipped ones mean, how overrides and derived values act,
// what advice is given. Mistakes are tested on the program (bad_scenes/).
#include <morsel/core/errors.h>
#include <morsel/fracture_run.h>
#include <morsel/scene/read.h>
#include <morsel/study/collection.h>
#include <morsel/study/run_study.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace Morsel;

namespace
{
  const std::string peanut = MORSEL_SOURCE_DIR "/prm/food/peanut.prm";


  bool
  advises(const std::vector<std::string> &overrides,
          const std::string              &part,
          const std::string              &base = peanut)
  {
    const Scene::Scene scene = Scene::read_scene(base, overrides);
    for (const std::string &text : scene.warnings)
      if (text.find(part) != std::string::npos)
        return true;
    return false;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(scenes)

BOOST_AUTO_TEST_CASE(the_peanut_is_read)
{
  const Scene::Scene scene = Scene::read_scene(peanut);
  BOOST_TEST(scene.name == "peanut");
  BOOST_TEST(scene.depth == 0.01);
  BOOST_REQUIRE_EQUAL(scene.particle_bodies.size(), 1u);
  BOOST_REQUIRE_EQUAL(scene.plate_bodies.size(), 2u);
  BOOST_REQUIRE_EQUAL(scene.contact_pairs.size(), 2u);
  BOOST_TEST(scene.contact_pairs[0].food == "food");
  BOOST_TEST(scene.contact_pairs[0].plate == "lower plate");
  BOOST_TEST(scene.warnings.empty());

  const Scene::ParticleBody &food = scene.particle_bodies[0];
  BOOST_TEST(food.particles_across == 101u);
  BOOST_TEST(food.particles_high() == 101u);
  BOOST_TEST(food.spacing == 0.01 / 101);
  BOOST_TEST(food.damage.enabled);
  BOOST_TEST(food.material.youngs_modulus == 23.9e6);
  BOOST_TEST(food.material.compressive_strength ==
                 std::sqrt(2 * 23.9e6 * 214.3),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scene.plate_bodies[1].motion.velocity[1] == -0.1);
}


BOOST_AUTO_TEST_CASE(all_shipped_scenes_are_good)
{
  unsigned int n_scenes = 0;
  for (const auto &file :
       std::filesystem::recursive_directory_iterator(MORSEL_SOURCE_DIR "/prm"))
    // Cracked plates and studies have readers of their own.
    if (file.path().extension() == ".prm" &&
        !is_fracture_scene(file.path().string(), {}) &&
        !Study::is_study(file.path().string()) &&
        !Study::is_collection(file.path().string()))
      {
        BOOST_TEST_CONTEXT(file.path())
        {
          BOOST_CHECK_NO_THROW(Scene::read_scene(file.path().string()));
        }
        ++n_scenes;
      }
  BOOST_TEST(n_scenes >= 3u);
}


BOOST_AUTO_TEST_CASE(all_shipped_studies_are_sound)
{
  for (const auto &file : std::filesystem::recursive_directory_iterator(
           MORSEL_SOURCE_DIR "/prm/studies"))
    if (file.is_regular_file() && Study::is_study(file.path().string()))
      BOOST_TEST_CONTEXT(file.path())
      {
        BOOST_CHECK_NO_THROW(Study::prepare_study(file.path().string(), {}, 0));
        BOOST_CHECK_NO_THROW(Study::prepare_study(
            file.path().string(), {"Study/Quick=true"}, 0));
      }
}


BOOST_AUTO_TEST_CASE(a_variant_differs_by_its_own_entries_alone)
{
  const Scene::Scene scene =
      Scene::read_scene(MORSEL_SOURCE_DIR "/prm/food/raw_carrot.prm");
  BOOST_TEST(scene.name == "raw_carrot");
  BOOST_TEST(scene.particle_bodies[0].material.density == 1040.);
  BOOST_TEST(scene.particle_bodies[0].particles_across == 101u);
}


BOOST_AUTO_TEST_CASE(overrides_go_before_file_and_catalogue)
{
  const Scene::Scene scene =
      Scene::read_scene(peanut,
                        {"Body food/Particles/Particles across=51",
                         "Body food/Material/Density = 1000",
                         "Contact/Pairs = upper plate : food",
                         "Name = other"});
  BOOST_TEST(scene.particle_bodies[0].particles_across == 51u);
  BOOST_TEST(scene.particle_bodies[0].material.density == 1000.);
  BOOST_REQUIRE_EQUAL(scene.contact_pairs.size(), 1u);
  BOOST_TEST(scene.contact_pairs[0].food == "food");
  BOOST_TEST(scene.contact_pairs[0].plate == "upper plate");
  BOOST_TEST(scene.name == "other");
}


BOOST_AUTO_TEST_CASE(used_parameters_reproduce_the_scene)
{
  const Scene::Scene scene =
      Scene::read_scene(peanut, {"Body food/Damage/Weibull modulus=16"});
  const std::string file = (std::filesystem::temp_directory_path() /
                            ("used-" + std::to_string(getpid()) + ".prm"))
                               .string();
  std::ofstream(file) << scene.used_parameters;
  const Scene::Scene again = Scene::read_scene(file);
  std::filesystem::remove(file);

  BOOST_TEST(again.used_parameters == scene.used_parameters);
  BOOST_TEST(again.parameters_hash == scene.parameters_hash);
  BOOST_TEST(again.particle_bodies[0].material.compressive_strength ==
             scene.particle_bodies[0].material.compressive_strength);
  BOOST_TEST(Scene::read_scene(peanut).parameters_hash !=
             scene.parameters_hash);
}


BOOST_AUTO_TEST_CASE(the_smallest_numbers_are_written_back)
{
  // Below the smallest normal double.
  const Scene::Scene scene = Scene::read_scene(
      peanut, {"Body food/Material/Poisson's ratio=4.9e-324"});
  BOOST_TEST(scene.used_parameters.find("4.94065645841247e-324") !=
             std::string::npos);
}


BOOST_AUTO_TEST_CASE(scaled_mass_keeps_the_kinetic_energy_below_its_share)
{
  BOOST_TEST(Scene::read_scene(peanut).time.inertia_factor == 1.);
  BOOST_TEST(
      Scene::read_scene(peanut, {"Time/Mass scaling=7"}).time.inertia_factor ==
      7.);
  // Kinetic energy goes with the square of the speed, whose share it is.
  const auto factor_at = [](const double speed, const char *share) {
    return Scene::read_scene(peanut,
                             {"Time/Mass scaling=0",
                              std::string("Time/Kinetic share=") + share,
                              "Body upper plate/Motion/Velocity=0, " +
                                  std::to_string(-speed)})
        .time.inertia_factor;
  };
  const double slow = factor_at(0.01, "0.01");
  BOOST_TEST(slow == 4. * factor_at(0.02, "0.01"),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(slow == 0.1 * factor_at(0.01, "0.1"),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(factor_at(10., "0.01") == 1.);

  const auto   scene         = Scene::read_scene(peanut);
  const auto  &material      = scene.particle_bodies[0].material;
  const double nu            = material.poissons_ratio;
  const double strain_energy = 0.5 * material.compressive_strength *
                               material.compressive_strength * (1. - nu * nu) /
                               material.youngs_modulus;
  BOOST_TEST(slow * material.density * 0.01 * 0.01 / 6. ==
                 0.0075 * strain_energy,
             boost::test_tools::tolerance(1e-9));
}


BOOST_AUTO_TEST_CASE(a_domain_that_is_not_given_encloses_the_bodies)
{
  const std::string file = (std::filesystem::temp_directory_path() /
                            ("block-" + std::to_string(getpid()) + ".prm"))
                               .string();
  std::ofstream(file) << "set Bodies = block\n"
                         "subsection Body block\n"
                         "subsection Shape\n"
                         "set Upper corner = 0.02, 0.01\n"
                         "end\n"
                         "subsection Particles\n"
                         "set Particles across = 40\n"
                         "end\n"
                         "subsection Material\n"
                         "set Name = basalt\n"
                         "end\n"
                         "end\n";
  const Scene::Scene scene = Scene::read_scene(file);
  std::filesystem::remove(file);
  BOOST_TEST(scene.domain.lower_corner[0] == -0.01);
  BOOST_TEST(scene.domain.upper_corner[1] == 0.015);
  BOOST_TEST(scene.particle_bodies[0].particles_high() == 20u);
  BOOST_TEST(scene.contact_pairs.empty());
}


BOOST_AUTO_TEST_CASE(unwise_choices_bring_advice)
{
  const std::string across = "Body food/Particles/Particles across=";
  BOOST_TEST(advises({across + "18"}, "only 18 particles thick"));
  BOOST_TEST(advises({across + "2000"}, "GB of memory"));
  BOOST_TEST(
      advises({"Body upper plate/Motion/Velocity=0, -1"}, "not quasi-static"));
  BOOST_TEST(advises({"Body upper plate/Motion/Velocity=0, -30"},
                     "an impact, not chewing"));
  BOOST_TEST(advises({"Depth=10"}, "in metres"));
  BOOST_TEST(advises({"Contact/Stiffness=100"}, "so stiff a contact"));
  BOOST_TEST(advises({"Contact/Stiffness=0.001"}, "so soft a contact"));
  BOOST_TEST(
      advises({"Body food/Material/Compressive strength=1"}, "suspicious"));
  BOOST_TEST(advises({"Time/Time step=6e-7"}, "close to the stable step"));
  BOOST_TEST(advises({"Body upper plate/Shape/Lower corner=-0.005, 0.0105"},
                     "a way that takes 0.005 s"));
  BOOST_TEST(advises({"Body block/Particles/Particles across=61"},
                     "not a multiple of the spacing",
                     MORSEL_SOURCE_DIR "/prm/sph/tension_block.prm"));
}


BOOST_AUTO_TEST_CASE(several_mistakes_are_told_at_once)
{
  try
    {
      Scene::read_scene(peanut,
                        {"Depth=0", "Body food/Material/Poisson's ratio=0.5"});
      BOOST_ERROR("no mistake found");
    }
  catch (const InputError &error)
    {
      const std::string text = error.what();
      BOOST_TEST(text.find("'Depth'") != std::string::npos);
      BOOST_TEST(text.find("\n--set \"Body food/Material/Poisson's ratio") !=
                 std::string::npos);
    }
}

BOOST_AUTO_TEST_SUITE_END()
