// Proves: the explicit solid with the conforming gradient has the forces of
// the static one at small strain, and cracks keep pairs apart.
#include "solid_scene.h"

#include <morsel/sph/body_cloud.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/discrete_gradient.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Morsel;
using namespace Morsel::SPH;

namespace
{
  constexpr double dp = 1e-4;


  Scene::Scene
  scattered_block(const std::string &normalisation)
  {
    Scene::Scene scene       = scene_of_block(18, 15, dp, 0.3);
    auto        &body        = scene.particle_bodies[0];
    body.scatter             = 0.2;
    body.material.law        = "linear";
    body.solid.normalisation = normalisation;
    return scene;
  }


  /// Displacements up to a hundredth of a spacing.
  VectorField
  noise(const unsigned int n)
  {
    std::mt19937                           generator(2);
    std::uniform_real_distribution<double> uniform(-0.01 * dp, 0.01 * dp);
    VectorField                            u(n);
    for (auto &v : u)
      for (unsigned int d = 0; d < 2; ++d)
        v[d] = uniform(generator);
    return u;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(conforming_solid)

BOOST_AUTO_TEST_CASE(forces_are_those_of_the_static_solid)
{
  for (const bool cracked : {false, true})
    {
      Scene::Scene scene = scattered_block("auto");
      if (cracked)
        scene.particle_bodies[0].cracks.paths =
            "0, " + std::to_string(7.43 * dp) + " > " +
            std::to_string(9.3 * dp) + ", " + std::to_string(7.43 * dp);
      const auto       &body = scene.particle_bodies[0];
      Solid             solid(body, scene, MPI_COMM_SELF);
      Particles        &p = solid.state();
      const VectorField u = noise(p.n_owned);
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          p.motion[i].u_x = u[i][0];
          p.motion[i].u_y = u[i][1];
        }
      solid.compute_accelerations(0.);

      const Cloud      cloud = body_cloud(body, scene.seed);
      const Kernel     kernel(KernelKind::cubic_b_spline, 1.3 * dp);
      const Visibility visibility =
          visibility_in(body, cloud.points, kernel.support());
      const ShapeFunctions   shape(cloud, kernel, visibility);
      const DiscreteGradient gradient = conforming_gradient(shape);
      const ResidualControl  control  = residual_control(
          shape, body.solid.hourglass * body.material.youngs_modulus);
      const auto &material = solid.get_material();
      TensorField stress;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const auto   H     = gradient.gradient(i, u);
          const double trace = H[0][0] + H[1][1];
          auto         sigma = material.mu * (H + transpose(H));
          for (unsigned int d = 0; d < 2; ++d)
            sigma[d][d] += material.lambda * trace;
          stress.push_back(sigma);
        }
      VectorField force(p.n_owned);
      gradient.add_force(stress, force);
      control.add_force(u, force);
      double worst = 0., largest = 0., mass = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const double per_depth = p.mass[i] / scene.depth;
          worst                  = std::max(
              worst,
              std::hypot(per_depth * p.acceleration[i].x - force[i][0],
                         per_depth * p.acceleration[i].y - force[i][1]));
          largest = std::max(largest, force[i].norm());
          mass += per_depth;
        }
      BOOST_TEST_MESSAGE((cracked ? "cracked" : "whole")
                         << " block: forces differ from those of the static "
                            "solid by "
                         << worst / largest << " of the largest");
      BOOST_TEST(worst < 1e-13 * largest);
      BOOST_TEST(mass == body.material.density * 18 * 15 * dp * dp,
                 boost::test_tools::tolerance(1e-12));
    }
}


BOOST_AUTO_TEST_CASE(nothing_passes_through_a_crack)
{
  // A crack all the way through: half of the body moves, the other half does
  // not know.
  for (const char *normalisation : {"gradient matrix", "conforming"})
    {
      Scene::Scene scene = scattered_block(normalisation);
      auto        &body  = scene.particle_bodies[0];
      body.cracks.paths  = "0, " + std::to_string(7.43 * dp) + " > " +
                          std::to_string(body.shape.upper_corner[0]) + ", " +
                          std::to_string(7.43 * dp);
      Solid      solid(body, scene, MPI_COMM_SELF);
      Particles &p = solid.state();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.reference[i][1] > 7.43 * dp)
          p.motion[i].u_y = 0.3 * dp;
      solid.compute_accelerations(0.);
      double largest = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        largest = std::max(
            largest, std::hypot(p.acceleration[i].x, p.acceleration[i].y));
      const double unit =
          solid.get_material().youngs_modulus / (p.mass[0] / p.volume(0) * dp);
      BOOST_TEST_MESSAGE(normalisation << ": acceleration " << largest / unit
                                       << " E/(rho dp)");
      BOOST_TEST(largest < 1e-13 * unit);
    }
}

BOOST_AUTO_TEST_CASE(edges_of_scattered_particles_lie_in_the_body)
{
  // A plate that touches the body presses on nothing yet.
  Scene::Scene scene = scattered_block("auto");
  auto        &body  = scene.particle_bodies[0];
  for (const double scatter : {0.2, 0.45})
    {
      body.scatter                 = scatter;
      const Solid          solid   = make_solid(scene);
      const Particles     &p       = solid.get_particles();
      const ParticleEdges &edges   = solid.get_edges();
      double               overlap = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const auto  &X    = p.reference[i];
          const double free = std::min({X[0],
                                        body.shape.upper_corner[0] - X[0],
                                        X[1],
                                        body.shape.upper_corner[1] - X[1]});
          overlap = std::max(overlap, edges.of_particle[i].distance - free);
        }
      BOOST_TEST_MESSAGE("scatter " << scatter << ": edges reach "
                                    << overlap / dp << " dp too far");
      BOOST_TEST(overlap < 1e-12 * dp);
    }
}

BOOST_AUTO_TEST_SUITE_END()
