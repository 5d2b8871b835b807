// Proves: contact forces derive from their energies and are equal and
// opposite, friction only takes energy away, a static block between plates
// tends to the closed form, and crushed food stays between the plates.
#include "../../source/bite.h"
#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Morsel;
using namespace Morsel::Contact;

namespace
{
  constexpr double dp = 1e-4;


  ParticleSide
  side_of_food()
  {
    ParticleSide side;
    side.spacing          = dp;
    side.depth            = 0.01;
    side.mass             = 1088. * dp * dp * side.depth;
    side.youngs_modulus   = 23.9e6;
    side.p_wave_modulus   = 32.2e6;
    side.smoothing_length = 1.3 * dp;
    return side;
  }


  ContactParameters
  law_named(const std::string &law, const double friction)
  {
    ContactParameters p;
    p.law      = law;
    p.friction = friction;
    return p;
  }


  Surface
  plate()
  {
    return rectangle_surface("plate", {0., -1e-3}, {2e-3, 0.}, 0.5 * dp);
  }


  /// Particles at random in the layer where contact acts, some around the
  /// plate's upper right corner.
  std::vector<dealii::Point<2>>
  near_plate(const unsigned int n)
  {
    std::mt19937                           generator(11);
    std::uniform_real_distribution<double> along(1e-4, 2.03e-3);
    std::uniform_real_distribution<double> height(0.1 * dp, 1.2 * dp);
    std::vector<dealii::Point<2>>          x;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double a = along(generator);
        x.emplace_back(a, height(generator));
      }
    return x;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(contact)

BOOST_AUTO_TEST_CASE(forces_are_equal_opposite_and_derived_from_the_energy)
{
  for (const char *law : {"gap penalty", "potential"})
    {
      const auto          x = near_plate(200);
      std::vector<Motion> motion(x.size(), {0., 0., 0., 0.});
      const auto          contact =
          make_plate_contact(law_named(law, 0.), side_of_food());
      Surface    surface = plate();
      const auto forces  = contact->compute(x, motion, x.size(), 1e-7, surface);

      // Net force, and net moment about the origin.
      auto   net  = surface.total_force();
      double size = 0., moment = 0.;
      for (unsigned int k = 0; k < surface.nodes.size(); ++k)
        moment += surface.nodes[k][0] * surface.force[k][1] -
                  surface.nodes[k][1] * surface.force[k][0];
      for (const auto &f : forces)
        {
          net += f.force;
          size += f.force.norm();
          moment +=
              x[f.particle][0] * f.force[1] - x[f.particle][1] * f.force[0];
          BOOST_TEST(f.force[1] > 0.); // pushed away
        }
      BOOST_TEST(forces.size() > 30u);
      BOOST_TEST(net.norm() < 1e-14 * size);
      BOOST_TEST(std::abs(moment) < 1e-14 * size * 2e-3);

      double       worst = 0., largest = 0.;
      const double step = 1e-6 * dp;
      for (const auto &f : std::vector<ParticleForce>(forces))
        for (unsigned int d = 0; d < 2; ++d)
          {
            double energy[2];
            for (const int sign : {0, 1})
              {
                auto &u =
                    d == 0 ? motion[f.particle].u_x : motion[f.particle].u_y;
                u = sign == 0 ? -step : step;
                contact->compute(x, motion, x.size(), 1e-7, surface);
                energy[sign] = contact->stored_energy();
                u            = 0.;
              }
            const double slope = (energy[1] - energy[0]) / (2. * step);
            worst              = std::max(worst, std::abs(f.force[d] + slope));
            largest            = std::max(largest, f.force.norm());
          }
      BOOST_TEST_MESSAGE(law << ": force against -dE/dx, error "
                             << worst / largest);
      BOOST_TEST(worst < 1e-6 * largest);
    }
}


BOOST_AUTO_TEST_CASE(gap_law_does_not_depend_on_the_place_along_the_plate)
{
  // And how much the potential does, for which it is known.
  for (const char *law : {"gap penalty", "potential"})
    {
      const auto contact =
          make_plate_contact(law_named(law, 0.), side_of_food());
      Surface surface = plate();
      double  least = 1e300, most = 0.;
      for (int k = 0; k < 50; ++k)
        {
          const std::vector<dealii::Point<2>> x{
              {1e-3 + 0.01 * k * dp, 0.4 * dp}};
          const std::vector<Motion> motion{{0., 0., 0., 0.}};
          const double              f =
              contact->compute(x, motion, 1, 1e-7, surface)[0].force[1];
          least = std::min(least, f);
          most  = std::max(most, f);
        }
      BOOST_TEST_MESSAGE(law << ": force along the plate varies by "
                             << most / least - 1.);
      if (law == std::string("gap penalty"))
        {
          BOOST_TEST(most / least - 1. < 1e-10);
          BOOST_TEST(most == 0.1 * dp * contact->stiffness(),
                     boost::test_tools::tolerance(1e-9));
        }
      else
        BOOST_TEST(most / least - 1. < 0.1);
    }
}


BOOST_AUTO_TEST_CASE(force_sets_in_without_a_step)
{
  // A step would make or take energy at every crossing of the range.
  for (const char *law : {"gap penalty", "potential"})
    {
      const auto contact =
          make_plate_contact(law_named(law, 0.), side_of_food());
      Surface      surface  = plate();
      const double in_touch = contact->stiffness() * dp;
      double       before   = 0.;
      for (double height = 1.6 * dp; height > 0.3 * dp; height -= 1e-3 * dp)
        {
          const std::vector<dealii::Point<2>> x{{1.02e-3, height}};
          const std::vector<Motion>           motion{{0., 0., 0., 0.}};
          const auto  &forces = contact->compute(x, motion, 1, 1e-7, surface);
          const double force  = forces.empty() ? 0. : forces[0].force[1];
          BOOST_REQUIRE(std::abs(force - before) < 0.01 * in_touch);
          before = force;
        }
      BOOST_TEST(before > 0.);
    }
}


BOOST_AUTO_TEST_CASE(friction_takes_energy_away_and_is_capped)
{
  std::mt19937                     generator(12);
  std::normal_distribution<double> normal(0., 0.3);
  const auto                       side = side_of_food();
  constexpr double                 dt = 1e-7, coefficient = 0.5;
  for (const char *law : {"gap penalty", "potential"})
    {
      const auto          x = near_plate(200);
      std::vector<Motion> motion(x.size());
      for (Motion &m : motion)
        m = {0., 0., normal(generator), normal(generator)};
      Surface surface = plate();
      for (auto &v : surface.velocity)
        v = dealii::Tensor<1, 2>({0.1, -0.2});

      const auto smooth = make_plate_contact(law_named(law, 0.), side);
      const auto rough  = make_plate_contact(law_named(law, coefficient), side);
      Surface    other  = surface;
      const auto without = smooth->compute(x, motion, x.size(), dt, other);
      const auto with    = rough->compute(x, motion, x.size(), dt, surface);
      BOOST_REQUIRE(with.size() == without.size());

      double power = 0.;
      auto   net   = surface.total_force();
      for (unsigned int k = 0; k < with.size(); ++k)
        {
          const Motion &m = motion[with[k].particle];
          const auto    v =
              dealii::Tensor<1, 2>({m.v_x, m.v_y}) - surface.velocity[0];
          const auto f = with[k].force - without[k].force;
          net += with[k].force;
          BOOST_REQUIRE(f * v <= 0.);
          // Several nodes of the potential share one particle.
          if (law == std::string("gap penalty"))
            {
              BOOST_REQUIRE(f.norm() <= coefficient * without[k].force.norm() *
                                            (1. + 1e-9));
              BOOST_REQUIRE(f.norm() * dt <= side.mass * v.norm());
            }
          power += f * v;
        }
      BOOST_TEST(net.norm() < 1e-12 * side.p_wave_modulus * dp * side.depth);
      BOOST_TEST(rough->friction_heat() == -power * dt,
                 boost::test_tools::tolerance(1e-10));
      BOOST_TEST(rough->stored_energy() == smooth->stored_energy(),
                 boost::test_tools::tolerance(1e-12));
    }
}


BOOST_AUTO_TEST_CASE(particle_bounces_back_with_its_energy)
{
  const auto side = side_of_food();
  for (const char *law : {"gap penalty", "potential"})
    {
      const auto contact = make_plate_contact(law_named(law, 0.), side);
      Surface    surface = plate();
      const std::vector<dealii::Point<2>> x{{1.02e-3, 1.6 * dp}};
      std::vector<Motion>                 motion{{0., 0., 0., -0.5}};
      const double dt = 0.05 * std::sqrt(side.mass / contact->stiffness());
      double       v = -0.5, lowest = 1e300;
      for (int k = 0; k < 100000 && x[0][1] + motion[0].u_y < 1.7 * dp; ++k)
        {
          for (auto &f : surface.force)
            f = 0.;
          const auto &f = contact->compute(x, motion, 1, dt, surface);
          v += dt * (f.empty() ? 0. : f[0].force[1] / side.mass);
          motion[0].u_y += dt * v;
          motion[0].v_y = v;
          lowest        = std::min(lowest, x[0][1] + motion[0].u_y);
        }
      BOOST_TEST_MESSAGE(law << ": bounces back at " << v / 0.5
                             << " of its speed, as near as " << lowest / dp
                             << " spacings");
      BOOST_TEST(v == 0.5, boost::test_tools::tolerance(0.02));
      BOOST_TEST(lowest > 0.);
    }
}


BOOST_AUTO_TEST_CASE(static_block_tends_to_the_closed_form)
{
  double       last_modulus = 0., last_inner = 0.;
  const double exact = 23.9e6 / (1. - 0.3 * 0.3);
  for (const unsigned int n : {10u, 20u, 40u})
    {
      constexpr double H = 0.01, c = 172., ramp = 20. * H / c;
      Scene::Scene     scene = SPH::scene_of_stroke(n, 0.01, ramp);
      auto            &body  = scene.particle_bodies[0];
      body.material.law      = "linear";
      RunLog log("", true, false);
      Bite   bite(scene, MPI_COMM_SELF, log);
      BOOST_REQUIRE(std::abs(bite.food().get_material().wave_speed / c - 1.) <
                    0.01);

      // Slope of the mean stress over strain from 0.75 to 2 ramp times, and
      // the same with the strain of the particles in the middle half.
      double s_x = 0., s_y = 0., s_xx = 0., s_xy = 0., s_z = 0., s_zy = 0.,
             s_zz          = 0.;
      unsigned int samples = 0;
      for (bite.evaluate(); bite.time() < 2. * ramp; bite.evaluate())
        {
          if (bite.time() > 0.75 * ramp)
            {
              const auto &p     = bite.food().get_particles();
              double      below = 0., above = 0.;
              const auto  row = [&](const unsigned int y) {
                double sum = 0.;
                for (unsigned int x = n / 4; x < n - n / 4; ++x)
                  sum += p.motion[y * n + x].u_y / (n - 2 * (n / 4));
                return sum;
              };
              below = row(n / 4);
              above = row(n - 1 - n / 4);
              const double z =
                  (below - above) / ((n - 1 - 2 * (n / 4)) * body.spacing);
              const double x = bite.closure() / H;
              const double y = 0.5 *
                               (bite.normal_force(0) + bite.normal_force(1)) /
                               (H * scene.depth);
              ++samples;
              s_x += x;
              s_y += y;
              s_z += z;
              s_xx += x * x;
              s_xy += x * y;
              s_zy += z * y;
              s_zz += z * z;
            }
          bite.advance();
        }
      const double modulus =
          (samples * s_xy - s_x * s_y) / (samples * s_xx - s_x * s_x) / exact;
      const double inner =
          (samples * s_zy - s_z * s_y) / (samples * s_zz - s_z * s_z) / exact;
      const auto e = bite.energies();
      BOOST_TEST_MESSAGE(
          n << " across: modulus over E/(1-nu^2) from the plates " << modulus
            << ", in the middle " << inner << "; kinetic over strain energy "
            << e.kinetic / e.strain << ", energy balance "
            << (e.external_work - e.stored() - e.dissipated()) /
                   e.external_work);
      BOOST_TEST(modulus == 1., boost::test_tools::tolerance(0.12 / n));
      BOOST_TEST(inner == 1., boost::test_tools::tolerance(0.05 / n));
      if (last_modulus != 0.)
        {
          const double order =
              std::log2(std::abs((last_modulus - 1.) / (modulus - 1.)));
          BOOST_TEST_MESSAGE("order " << order << ", extrapolated modulus "
                                      << 2. * modulus - last_modulus
                                      << ", in the middle "
                                      << 2. * inner - last_inner);
          BOOST_TEST(order > 0.85);
          BOOST_TEST(2. * modulus - last_modulus == 1.,
                     boost::test_tools::tolerance(0.002));
        }
      last_modulus = modulus;
      last_inner   = inner;
    }
}


BOOST_AUTO_TEST_CASE(crushed_food_stays_between_the_plates)
{
  // Strength next to nothing: all of it fails, and is pressed to 70 %.
  constexpr double H                 = 0.01;
  Scene::Scene     scene             = SPH::scene_of_stroke(20, 1., 1e-4);
  auto            &body              = scene.particle_bodies[0];
  body.damage.enabled                = true;
  body.damage.flaws                  = "uniform";
  body.material.compressive_strength = 1e3;
  scene.contact.friction             = 0.5;
  RunLog      log("", true, false);
  Bite        bite(scene, MPI_COMM_SELF, log);
  double      largest_ratio = 0., error = 0., momentum_error = 0.;
  double      outermost = 1e300, tension = 0., scale = 0.;
  const auto &p = bite.food().get_particles();
  for (bite.evaluate(); bite.closure() < 0.3 * H; bite.evaluate())
    {
      if (bite.step() % 20 == 0)
        {
          const auto e = bite.energies();
          scale        = std::max(scale, e.external_work);
          error        = std::max(
              error, std::abs(e.external_work - e.stored() - e.dissipated()));
          BOOST_REQUIRE(bite.food().inverted_count() == 0u);
          const double upper = bite.get_plates()[1].surface.nodes[0][1];
          for (unsigned int i = 0; i < p.n_owned; ++i)
            {
              const double y = p.position(i)[1];
              outermost      = std::min({outermost, y, upper - y});
              if (p.failed[i])
                {
                  const auto s = bite.food().stress(i);
                  tension      = std::max(tension, s.xx + s.yy + s.zz);
                  BOOST_REQUIRE(bite.food().density_ratio(i) > 0.);
                }
              largest_ratio =
                  std::max(largest_ratio, bite.food().density_ratio(i));
            }
          auto momentum = bite.momentum();
          for (const auto &impulse : bite.impulses())
            momentum -= impulse;
          momentum_error = std::max(momentum_error, momentum.norm());
        }
      bite.advance();
    }
  BOOST_TEST(!Guards(bite.guarded()).check_particles());
  BOOST_TEST(!Guards(bite.guarded()).check_contacts());
  BOOST_TEST_MESSAGE(
      "crushed to 70 %: failed share "
      << bite.food().failed_share() << ", " << bite.step()
      << " steps, nearest to a plate " << outermost / body.spacing
      << " spacings, density ratio up to " << largest_ratio
      << ", stress carried " << bite.normal_force(1) / (H * scene.depth) / 1e3
      << " kPa, energy balance within " << error / scale
      << " of the work, momentum within "
      << momentum_error / (p.mass[0] * p.n_owned));
  BOOST_TEST(bite.food().failed_share() > 0.9);
  BOOST_TEST(outermost > 0.);
  BOOST_TEST(tension <= 1e-9);
  BOOST_TEST(largest_ratio < 2.);
  BOOST_TEST(error < 0.04 * scale);
  BOOST_TEST(momentum_error < 1e-13 * p.mass[0] * p.n_owned);
}

BOOST_AUTO_TEST_SUITE_END()
