// Proves, on the smallest cases: that particles of either formulation do not
// interact past a crack and do elsewhere, that the gauge of a body's crack
// finds the stress intensity factors of a field that is known, and that its
// mistakes have a sentence.
#include <morsel/core/errors.h>
#include <morsel/fracture/tip_fields.h>
#include <morsel/measure/crack_gauge.h>

#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

using namespace Morsel;

namespace
{
  constexpr double spacing = 1e-3;

  Scene::Scene
  cracked_scene(const unsigned int n,
                const std::string &formulation,
                const std::string &paths)
  {
    Scene::Scene scene = SPH::scene_of_formulation(formulation, n, n, spacing);
    scene.particle_bodies.front().cracks.paths = paths;
    return scene;
  }
} // namespace


BOOST_AUTO_TEST_CASE(crack_halves_do_not_pull)
{
  // The upper half moves off: it meets resistance ahead of the crack alone.
  for (const std::string formulation :
       {"total Lagrangian", "updated Lagrangian"})
    {
      const auto scene = cracked_scene(12, formulation, "-0.006, 0 > 0.002, 0");
      const auto body  = SPH::make_body(scene);
      auto      &p     = body->state();
      // Both forms answer after one step, the updated one by its rates.
      const double dt = body->stable_time_step(0.);
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.reference[i][1] > 0.)
          p.half_velocity[i].y = 0.01 * spacing / dt;
      body->compute_accelerations(dt);
      body->advance(dt);
      body->compute_accelerations(dt);
      double behind = 0., ahead = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const double a = std::abs(p.acceleration[i].y);
          // Two supports behind the tip and one ahead of it.
          if (p.reference[i][0] < -0.0032)
            behind = std::max(behind, a);
          if (p.reference[i][0] > 0.0045)
            ahead = std::max(ahead, a);
        }
      BOOST_TEST(ahead > 0.);
      BOOST_TEST(behind < 1e-10 * ahead);
      const auto whole = SPH::make_body(cracked_scene(12, formulation, ""));
      BOOST_TEST(body->neighbours_per_particle() <
                 whole->neighbours_per_particle());
    }
}


BOOST_AUTO_TEST_CASE(crack_gauge_knows_williams_field)
{
  for (const std::string formulation :
       {"total Lagrangian", "updated Lagrangian"})
    {
      const auto scene = cracked_scene(40, formulation, "-0.02, 0 > 0, 0");
      const auto body  = SPH::make_body(scene);
      const Measure::CrackGauge gauge(
          scene.particle_bodies.front(), *body, scene.seed);
      BOOST_REQUIRE_EQUAL(gauge.get_tips().size(), 1u);
      const Fracture::ElasticPlane material(1e7, 0.3, false);
      auto                        &p = body->state();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const auto u =
              Fracture::williams_field(
                  gauge.get_tips()[0], material, 2., 1., p.reference[i])
                  .value;
          p.motion[i].u_x = u[0];
          p.motion[i].u_y = u[1];
        }
      const auto results = gauge.evaluate();
      BOOST_REQUIRE_EQUAL(results.size(), 1u);
      BOOST_TEST_MESSAGE("K_I " << results[0].statistics.mean.mode_I << " K_II "
                                << results[0].statistics.mean.mode_II);
      BOOST_TEST(std::abs(results[0].statistics.mean.mode_I - 2.) < 0.02);
      BOOST_TEST(std::abs(results[0].statistics.mean.mode_II - 1.) < 0.02);
    }
}


BOOST_AUTO_TEST_CASE(cracks_of_bodies_are_checked)
{
  const auto message = [](const std::string &paths) {
    try
      {
        SPH::make_body(cracked_scene(10, "total Lagrangian", paths));
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  BOOST_TEST(
      message("-0.005, 0.0005 > -0.002, 0.0005").find("lies on a crack") !=
      std::string::npos);
  BOOST_TEST(message("-0.005, 0.02 > 0.003, 0").find("body 'block'") !=
             std::string::npos);
  BOOST_TEST(message("-0.005, 0").find("'Body block/Cracks/Paths'") !=
             std::string::npos);
}
