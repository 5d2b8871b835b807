// Proves, on the smallest cases, that bodies of any shape move over time as
// they should: a disc has its mass, keeps energy and momentum while it
// vibrates and flies, and the two sides of a slot do not feel each other.
#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Morsel;

namespace
{
  Scene::Scene
  scene_of_shape(const Scene::BodyShape &shape,
                 const unsigned int      across,
                 const std::string      &filling)
  {
    Scene::Scene scene =
        SPH::scene_of_formulation("total Lagrangian", across, 2, 1e-3);
    auto &body   = scene.particle_bodies.front();
    body.shape   = shape;
    body.filling = filling;
    body.shape.complete(across, ".");
    body.particles_across = across;
    body.spacing          = body.shape.extent(0) / across;
    return scene;
  }
} // namespace


BOOST_AUTO_TEST_CASE(disc_keeps_mass_energy_and_momentum)
{
  Scene::BodyShape disc;
  disc.kind         = "annulus";
  disc.outer_radius = 0.01;
  for (const std::string filling : {"lattice", "relaxed"})
    {
      const auto scene = scene_of_shape(disc, 16, filling);
      const auto body  = SPH::make_body(scene);
      auto      &p     = body->state();
      double     mass  = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          mass += p.mass[i];
          // Flight, and a stretching that makes it vibrate.
          const auto &X      = p.reference[i];
          p.half_velocity[i] = {0.1 + 2. * X[0], -2. * X[1]};
          p.motion[i].v_x    = p.half_velocity[i].x;
          p.motion[i].v_y    = p.half_velocity[i].y;
        }
      // Its polygon has the circle's area.
      BOOST_TEST(std::abs(mass / (1000. * M_PI * 1e-4) - 1.) < 1e-10);

      const double dt       = body->stable_time_step(0.);
      const auto   momentum = body->momentum();
      body->compute_accelerations(dt);
      const auto   begin  = body->energies();
      const double first  = begin.strain + begin.hourglass + begin.kinetic;
      double       strain = 0., drift = 0.;
      for (unsigned int step = 0; step < 300; ++step)
        {
          body->advance(dt);
          body->compute_accelerations(dt);
          const auto e = body->energies();
          strain       = std::max(strain, e.strain);
          drift        = std::max(
              drift,
              std::abs(e.strain + e.hourglass + e.kinetic - first) / first);
        }
      BOOST_TEST(strain > 1e-3 * first);
      BOOST_TEST(drift < 1e-3);
      const auto end = body->momentum();
      BOOST_TEST(std::abs(end.x - momentum.x) < 1e-12 * std::abs(momentum.x));
      BOOST_TEST(std::abs(end.y - momentum.y) < 1e-12 * std::abs(momentum.x));
    }
}


BOOST_AUTO_TEST_CASE(slot_parts_moving_fingers)
{
  Scene::BodyShape shape;
  shape.kind  = "polygon";
  shape.loops = "0, 0 > 2, 0 > 2, 1 > 0.4, 1 > 0.4, 1.05 > 2, 1.05 > "
                "2, 2.05 > 0, 2.05";
  for (const char *normalisation : {"conforming", "gradient matrix"})
    {
      auto scene = scene_of_shape(shape, 20, "relaxed");
      scene.particle_bodies.front().solid.normalisation = normalisation;
      const auto body                                   = SPH::make_body(scene);
      auto      &p                                      = body->state();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.reference[i][0] > 1.2 && p.reference[i][1] > 1.02)
          p.motion[i].u_y = 1e-3;
      body->compute_accelerations(body->stable_time_step(0.));
      double upper = 0., lower = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.reference[i][0] > 0.9)
          (p.reference[i][1] > 1.02 ? upper : lower) +=
              std::abs(p.acceleration[i].y);
      BOOST_TEST(upper > 0.);
      BOOST_TEST(lower < 1e-10 * upper);
    }
}
