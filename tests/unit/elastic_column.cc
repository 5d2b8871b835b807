// Proves: a column of food and elastic plates has the stiffness of its parts in
// series and closes its ledgers, and 'auto' tells stiff, soft and slow plates
// apart.
#include "../../source/bite.h"
#include "../../source/elastic_plates.h"
#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

using namespace Morsel;

namespace
{
  namespace tt = boost::test_tools;

  /// A column of food between plates as wide as itself, all with Poisson's
  /// ratio 0, pressed together by 0.5 % of its height.
  Scene::Scene
  scene_of_column(const std::string &response)
  {
    constexpr double h           = 0.01;
    Scene::Scene     scene       = SPH::scene_of_stroke(16, 0.05, 1e-3);
    auto            &food        = scene.particle_bodies[0];
    food.material.law            = "linear";
    food.material.poissons_ratio = 0.;
    food.solid.viscosity         = "off";
    for (auto &plate : scene.plate_bodies)
      {
        const bool upper                 = plate.name == "upper";
        plate.shape.lower_corner         = {0., upper ? h : -0.2 * h};
        plate.shape.upper_corner         = {h, upper ? 1.2 * h : 0.};
        plate.deformation.elastic        = true;
        plate.deformation.response       = response;
        plate.deformation.held_sides     = upper ? "top" : "bottom";
        plate.deformation.cell_size      = h / 11.;
        plate.deformation.density        = 2000.;
        plate.deformation.youngs_modulus = 2.39e7;
      }
    return scene;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(elastic_column)

BOOST_AUTO_TEST_CASE(column_has_the_stiffness_of_its_parts_in_series)
{
  constexpr double E       = 23.9e6;
  double           of_food = 0.;
  for (const char *response : {"rigid", "quasi-static", "dynamic"})
    {
      const Scene::Scene scene = scene_of_column(response);
      RunLog             log("", true, false);
      Bite               bite(scene, MPI_COMM_SELF, log);
      // Means of a linear rise: the ramp's end to 2.5 ramps.
      double n = 0., x = 0., y = 0., xx = 0., xy = 0., energy_error = 0.,
             momentum_error = 0., scale = 0., impulse_scale = 0.;
      for (bite.evaluate(); bite.time() < 2.5e-3; bite.evaluate())
        {
          const double force =
              0.5 * (bite.normal_force(0) + bite.normal_force(1));
          const double closure = bite.closure();
          if (bite.time() > 1e-3)
            {
              n += 1.;
              x += closure;
              y += force;
              xx += closure * closure;
              xy += closure * force;
            }
          const auto e = bite.energies();
          scale        = std::max(scale, e.largest_term());
          energy_error =
              std::max(energy_error,
                       std::abs(e.external_work - e.stored() - e.dissipated()));
          auto momentum = bite.momentum();
          for (const auto &impulse : bite.impulses())
            momentum -= impulse;
          momentum_error = std::max(momentum_error, momentum.norm());
          impulse_scale  = std::max(impulse_scale, bite.impulses()[0].norm());
          bite.advance();
        }
      const double stiffness = (n * xy - x * y) / (n * xx - x * x);
      if (of_food == 0.)
        of_food = stiffness;
      // The food as it is between rigid plates, and two plates of a fifth of
      // its height and the same modulus.
      const bool   rigid = response == std::string("rigid");
      const double exact =
          rigid ? E * scene.depth
                : 1. / (1. / of_food + 2. * 0.2 / (E * scene.depth));
      BOOST_TEST_MESSAGE(response
                         << ": stiffness over that of the series "
                         << stiffness / exact << ", energy ledger within "
                         << energy_error / scale << ", momentum within "
                         << momentum_error / impulse_scale << "; "
                         << bite.step() << " steps");
      BOOST_TEST(stiffness == exact, tt::tolerance(rigid ? 0.02 : 1e-3));
      BOOST_TEST(energy_error < 1e-4 * scale);
      BOOST_TEST(momentum_error < 1e-11 * impulse_scale);
    }
}


BOOST_AUTO_TEST_CASE(friction_feeds_no_plate)
{
  // Enamel in cells of a third of a spacing, and a plate that is soft.
  const struct
  {
    const char *response;
    double      modulus;
  } cases[] = {{"dynamic", 80e9}, {"dynamic", 239e6}, {"quasi-static", 239e6}};
  for (const auto &c : cases)
    {
      Scene::Scene scene     = scene_of_column(c.response);
      scene.contact.friction = 0.5;
      scene.particle_bodies[0].material.poissons_ratio = 0.3;
      for (auto &plate : scene.plate_bodies)
        {
          plate.deformation.youngs_modulus = c.modulus;
          plate.deformation.cell_size      = 2e-4;
          plate.motion.ramp_time           = 1e-4;
        }
      RunLog log("", true, false);
      Bite   bite(scene, MPI_COMM_SELF, log);
      double error = 0., scale = 0.;
      for (bite.evaluate(); bite.time() < 3e-4; bite.evaluate())
        {
          const auto e = bite.energies();
          scale        = std::max(scale, e.largest_term());
          error        = std::max(
              error, std::abs(e.external_work - e.stored() - e.dissipated()));
          bite.advance();
        }
      BOOST_TEST_MESSAGE(
          c.response << ", E = " << c.modulus << " Pa: energy ledger within "
                     << error / scale << ", " << bite.step() << " steps");
      BOOST_TEST(error < 0.005 * scale);
    }
}


BOOST_AUTO_TEST_CASE(auto_chooses_by_stiffness_and_period)
{
  const auto choose = [](const double modulus, const double speed) {
    Scene::Scene scene         = scene_of_column("auto");
    scene.stop.maximum_closure = 0.01;
    for (auto &plate : scene.plate_bodies)
      {
        plate.deformation.youngs_modulus = modulus;
        plate.motion.velocity *= speed / 0.05;
      }
    const auto &plate = scene.plate_bodies[1];
    return choose_response(scene, plate, *make_elastic_body(scene, plate))
        .response;
  };
  // The plate yields by a fifth of the food at the same modulus: 1 % at 20 E.
  BOOST_TEST(choose(20. * 23.9e6 * 1.02, 0.05) == "rigid");
  BOOST_TEST(choose(20. * 23.9e6 * 0.98, 0.05) == "quasi-static");
  BOOST_TEST(choose(23.9e6, 0.05) == "quasi-static");
  BOOST_TEST(choose(23.9e6, 5.) == "dynamic");
}

BOOST_AUTO_TEST_SUITE_END()
