// Proves: which grain holds a place does not depend on the particles, factors
// have the scatter that is asked for, two halves of different stiffness in
// series have the modulus of Reuss, and a solid of grains that breaks keeps
// its account of energy.
#include "../../source/bite.h"
#include "solid_scene.h"

#include <morsel/materials/grains.h>

#include <boost/test/unit_test.hpp>

#include <set>

using namespace Morsel;
using Materials::GrainField;
using Materials::GrainParameters;

namespace
{
  Scene::Scene
  scene_of_grains(const unsigned int nx,
                  const unsigned int ny,
                  const double       spacing)
  {
    Scene::Scene scene     = SPH::scene_of_block(nx, ny, spacing, 0.3);
    auto        &grains    = scene.particle_bodies.front().grains;
    grains.size            = 1e-3;
    grains.modulus_scatter = 0.4;
    return scene;
  }


  /// Sum of the vertical inner forces on the rows from @p begin to @p end of
  /// a lattice [N].
  double
  force_on_rows(const SPH::Particles &p,
                const unsigned int    begin,
                const unsigned int    end)
  {
    double sum = 0.;
    for (unsigned int i = begin; i < end; ++i)
      sum += p.mass[i] * p.acceleration[i].y;
    return sum;
  }


  /// Force that holds a block stretched whose upper half is @p factor times
  /// as stiff as the lower one, relative to factor one. Brought to rest by
  /// dynamic relaxation; the outermost rows are held.
  double
  force_of_two_halves(const unsigned int n_rows,
                      const double       factor,
                      const bool         conforming)
  {
    constexpr unsigned int nx = 8;
    Scene::Scene scene = SPH::scene_of_block(nx, n_rows, 1e-3 / n_rows, 0.);
    auto        &body  = scene.particle_bodies.front();
    body.material.law  = "linear";
    if (conforming)
      body.solid.normalisation = "conforming";
    body.grains           = {1., 1e-6, 0.};
    SPH::Solid      solid = SPH::make_solid(scene);
    SPH::Particles &p     = SPH::state_of(solid);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        p.hourglass[i] /= p.modulus[i];
        p.modulus[i] = i < p.n_owned / 2 ? 1. : factor;
        p.hourglass[i] *= p.modulus[i];
        p.motion[i].u_y = 1e-3 * p.reference[i][1];
      }

    const double dt   = solid.stable_time_step(0.) / std::sqrt(factor);
    double       last = 0., force = 0.;
    for (unsigned int step = 1; step < 100000; ++step)
      {
        solid.compute_accelerations(dt);
        if (step % 500 == 0)
          {
            last  = force;
            force = force_on_rows(p, 0, nx);
            if (std::abs(force - last) < 1e-7 * std::abs(force))
              break;
          }
        for (unsigned int i = 0; i < p.n_owned; ++i)
          if (i < nx || i >= p.n_owned - nx)
            p.acceleration[i] = {0., 0.};
          else
            {
              // Nearly critical for the slowest wave through the block.
              const double c = 3. * solid.get_material().wave_speed / 1e-3;
              p.acceleration[i].x -= c * p.half_velocity[i].x;
              p.acceleration[i].y -= c * p.half_velocity[i].y;
            }
        solid.advance(dt);
      }
    return force;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(grains)


BOOST_AUTO_TEST_CASE(factors_have_their_mean_and_scatter)
{
  const double          nu = 0.3;
  const GrainParameters parameters{1e-3, 0.4, 0.2};
  const GrainField      field(parameters, nu, 5);

  // One place in each of many grains: every tenth square's own.
  std::set<std::pair<long, long>> seen;
  double                          m = 0., mm = 0., s = 0., ss = 0., ms = 0.;
  for (int i = -150; i < 150; ++i)
    for (int j = -150; j < 150; ++j)
      {
        const dealii::Point<2> x(1e-3 * i, 1e-3 * j);
        if (!seen.insert(field.grain_at(x)).second)
          continue;
        const double a = field.modulus_factor(x), b = field.strength_factor(x);
        m += a, mm += a * a, s += b, ss += b * b, ms += a * b;
      }
  const double n = seen.size();
  m /= n, s /= n;
  const double scatter_m = std::sqrt(mm / n - m * m) / m,
               scatter_s = std::sqrt(ss / n - s * s) / s;
  BOOST_TEST_MESSAGE(n << " grains: mean " << m << ", " << s << ", scatter "
                       << scatter_m << ", " << scatter_s);
  BOOST_TEST(m == std::pow(1.16, Materials::homogenisation_exponent(nu)),
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(s == 1., boost::test_tools::tolerance(0.005));
  BOOST_TEST(scatter_m == 0.4, boost::test_tools::tolerance(0.03));
  BOOST_TEST(scatter_s == 0.2, boost::test_tools::tolerance(0.03));
  const double correlation = (ms / n - m * s) / (0.4 * m * 0.2);
  BOOST_TEST(std::abs(correlation) < 0.02);
}


BOOST_AUTO_TEST_CASE(a_grain_is_as_large_as_a_circle_of_its_diameter)
{
  const GrainField                field({1e-3, 0.4, 0.}, 0.3, 5);
  std::set<std::pair<long, long>> seen;
  const int                       n    = 400;
  const double                    side = 0.05;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      seen.insert(field.grain_at({side * (i + 0.5) / n, side * (j + 0.5) / n}));
  const double grains = side * side / (0.25 * 3.14159265 * 1e-6);
  BOOST_TEST_MESSAGE(seen.size() << " grains met, " << grains << " expected");
  // Those that the edge cuts are met, too.
  BOOST_TEST(seen.size() > grains);
  BOOST_TEST(seen.size() < grains * 1.06);
}


BOOST_AUTO_TEST_CASE(exponent_of_homogenisation_in_its_limits)
{
  // Incompressible: as the shear modulus, one half. Without lateral strain
  // (nu = 0): (lambda + mu)/mu = 1, 5/8.
  BOOST_TEST(Materials::homogenisation_exponent(0.) == 0.625);
  BOOST_TEST(Materials::homogenisation_exponent(0.499999) == 0.5,
             boost::test_tools::tolerance(1e-4));
}


BOOST_AUTO_TEST_CASE(the_same_grains_at_every_spacing)
{
  // Places of the coarse lattice are among those of one three times as fine.
  const auto  coarse = SPH::make_solid(scene_of_grains(20, 20, 3e-4));
  const auto  fine   = SPH::make_solid(scene_of_grains(60, 60, 1e-4));
  const auto &p = coarse.get_particles(), &q = fine.get_particles();
  double      largest = 0., smallest = 10.;
  for (unsigned int y = 0; y < 20; ++y)
    for (unsigned int x = 0; x < 20; ++x)
      {
        const unsigned int i = 20 * y + x, j = 60 * (3 * y + 1) + 3 * x + 1;
        BOOST_REQUIRE(p.reference[i].distance(q.reference[j]) < 1e-12);
        BOOST_TEST(p.modulus[i] == q.modulus[j]);
        largest  = std::max(largest, p.modulus[i]);
        smallest = std::min(smallest, p.modulus[i]);
      }
  BOOST_TEST(largest / smallest > 2.);

  Scene::Scene off = scene_of_grains(20, 20, 3e-4);
  off.particle_bodies.front().grains.modulus_scatter = 0.;
  BOOST_TEST(SPH::make_solid(off).get_particles().modulus.empty());
}


BOOST_AUTO_TEST_CASE(two_halves_in_series_have_the_modulus_of_reuss)
{
  constexpr double factor = 4.;
  const double     exact  = 2. / (1. + 1. / factor);
  for (const bool conforming : {false, true})
    {
      double last = 0.;
      for (const unsigned int n_rows : {10u, 20u, 40u})
        {
          const double ratio = force_of_two_halves(n_rows, factor, conforming) /
                               force_of_two_halves(n_rows, 1., conforming);
          const double error = ratio / exact - 1.;
          BOOST_TEST_MESSAGE((conforming ? "conforming, " : "")
                             << n_rows << " rows: modulus " << ratio << ", "
                             << error << " above Reuss's " << exact);
          BOOST_TEST(std::abs(error) < 0.5 / n_rows);
          if (last != 0.)
            BOOST_TEST(std::abs(error) < 0.6 * std::abs(last));
          last = error;
        }
    }
}


BOOST_AUTO_TEST_CASE(stress_and_energy_of_a_grain_are_its_own)
{
  for (const char *const softening : {"deviator", "tensile principal"})
    {
      Scene::Scene scene    = scene_of_grains(24, 24, 2e-4);
      auto        &body     = scene.particle_bodies.front();
      body.damage.enabled   = true;
      body.damage.softening = softening;
      SPH::Solid      solid = SPH::make_solid(scene);
      SPH::Particles &p     = SPH::state_of(solid);
      for (unsigned int i = 0; i < p.n_owned; ++i)
        p.motion[i].u_y = -1e-3 * p.reference[i][1];
      solid.compute_accelerations(1e-7);

      const Materials::Elasticity &m      = solid.get_material();
      double                       energy = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const Materials::Elasticity own(
              p.modulus[i] * m.youngs_modulus, m.poissons_ratio, m.density);
          const auto response =
              Materials::neo_hookean(own, {1., 0., 0., 1. - 1e-3});
          const auto stress = solid.stress(i);
          BOOST_REQUIRE(
              std::abs(stress.yy / (response.deviator.yy + response.mean) -
                       1.) < 1e-9);
          BOOST_REQUIRE(std::abs(p.effective[i].yy / stress.yy - 1.) < 1e-9);
          energy += p.volume(i) *
                    (response.deviatoric_energy + response.volumetric_energy);
        }
      BOOST_TEST(solid.energies().strain == energy,
                 boost::test_tools::tolerance(
                     std::string(softening) == "deviator" ? 1e-9 : 2e-3));
    }
}


BOOST_AUTO_TEST_CASE(a_stiff_grain_takes_the_same_fracture_energy)
{
  // Area under the curve of a tensile test, threshold r: the stress rises to
  // r f_t with the grain's own modulus and falls to zero at range r f_t.
  Materials::DamageParameters parameters;
  parameters.fracture_energy = 1e4;
  const Materials::Elasticity material(50e9, 0.25, 2700.);
  const Materials::DamageLaw  law(
      parameters, material, 100e6, {1e-3 * 1e-3, 1e-3});
  for (const double r : {0.8, 1.2})
    {
      const auto area = [&](const double factor) {
        return law.range_at(r, factor) * r * r / factor;
      };
      BOOST_TEST(area(2.) == area(1.), boost::test_tools::tolerance(1e-12));
    }
}


BOOST_AUTO_TEST_CASE(thresholds_of_a_grain_are_its_own)
{
  Scene::Scene scene  = scene_of_grains(30, 30, 2e-4);
  auto        &body   = scene.particle_bodies.front();
  body.damage.enabled = true;
  const auto even     = SPH::make_solid(scene).get_particles().threshold;
  body.grains.strength_scatter = 0.3;
  const auto       solid       = SPH::make_solid(scene);
  const GrainField field(body.grains, 0.3, scene.seed);
  const auto      &p = solid.get_particles();
  for (unsigned int i = 0; i < p.n_owned; ++i)
    BOOST_REQUIRE(std::abs(p.threshold[i] / even[i] /
                               field.strength_factor(p.reference[i]) -
                           1.) < 1e-12);
}


BOOST_AUTO_TEST_CASE(a_broken_block_of_grains_keeps_its_account_of_energy)
{
  for (const double scatter : {0., 0.4})
    {
      constexpr double H     = 0.01;
      Scene::Scene     scene = SPH::scene_of_stroke(30, 0.1, 1e-4);
      auto            &body  = scene.particle_bodies.front();
      body.damage.enabled    = true;
      body.grains            = {1.5e-3, scatter, 0.5 * scatter};
      RunLog log("", true, false);
      Bite   bite(scene, MPI_COMM_SELF, log);
      double error = 0., scale = 0., momentum = 0.;
      for (bite.evaluate(); bite.closure() < 0.02 * H; bite.evaluate())
        {
          if (bite.step() % 10 == 0)
            {
              const auto e = bite.energies();
              scale        = std::max(scale, e.external_work);
              error        = std::max(
                  error,
                  std::abs(e.external_work - e.stored() - e.dissipated()));
              auto difference = bite.momentum();
              for (const auto &impulse : bite.impulses())
                difference -= impulse;
              momentum = std::max(momentum, difference.norm());
            }
          bite.advance();
        }
      BOOST_TEST(!Guards(bite.guarded()).check_particles());
      BOOST_TEST(!Guards(bite.guarded()).check_contacts());
      BOOST_TEST_MESSAGE("modulus scatter "
                         << scatter << ": failed share "
                         << bite.food().failed_share() << ", " << bite.step()
                         << " steps, energy balance within " << error / scale
                         << " of the work");
      BOOST_TEST(bite.food().failed_share() > 0.1);
      BOOST_TEST(bite.food().inverted_count() == 0u);
      BOOST_TEST(error < 0.01 * scale);
      BOOST_TEST(momentum < 1e-12);
    }
}

BOOST_AUTO_TEST_SUITE_END()
