// Proves: a uniform pressure crosses contact between particles and finite
// elements of any spacing exactly, forces are equal, opposite and of the
// energy, and bodies exchange momentum and energy without loss.
#include "../../source/bite.h"
#include "solid_scene.h"

#include <morsel/contact/gap_penalty.h>
#include <morsel/fe/plate_mesh.h>
#include <morsel/jaw/quasi_static_deformation.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Morsel;

namespace
{
  namespace tt = boost::test_tools;

  std::unique_ptr<FE::ElasticBody>
  make_rectangle(const dealii::Point<2> &lower,
                 const dealii::Point<2> &upper,
                 const unsigned int      nx,
                 const unsigned int      ny,
                 const double            poissons_ratio,
                 const unsigned int      degree)
  {
    auto mesh = std::make_unique<dealii::Triangulation<2>>();
    FE::make_plate(*mesh, lower, upper, nx, ny);
    FE::ElasticBodyProperties p;
    p.youngs_modulus = 1e7;
    p.poissons_ratio = poissons_ratio;
    p.density        = 1000.;
    p.depth          = 0.01;
    p.degree         = degree;
    p.held           = {FE::PlateSide::bottom};
    return std::make_unique<FE::ElasticBody>(std::move(mesh), p);
  }


  ParticleSide
  row_of(const double spacing)
  {
    return {spacing, 0.01, 1000. * spacing * spacing * 0.01, 1e7, 1e7, spacing};
  }


  /// @p n particles side by side above [0, n spacing], their edges sunk by a
  /// depth below y = 0.
  std::vector<dealii::Point<2>>
  sunk_row(const unsigned int n, const double spacing, const double depth)
  {
    std::vector<dealii::Point<2>> x;
    for (unsigned int i = 0; i < n; ++i)
      x.emplace_back((i + 0.5) * spacing, 0.5 * spacing - depth);
    return x;
  }


  /// Largest deviation of the vertical stress from -1 and of the others from 0.
  double
  stress_error(const FE::ElasticBody &body,
               const Eigen::VectorXd &u,
               const double           pressure)
  {
    const auto fields = body.corner_fields(u);
    double     error  = 0.;
    for (unsigned int i = 0; i < fields.points.size(); ++i)
      for (unsigned int c = 0; c < 4; ++c)
        error = std::max(
            error,
            std::abs(fields.stress[4 * i + c] / pressure + (c == 3 ? 1. : 0.)));
    return error;
  }


  /// A bar of particles that flies at 0.1 m/s into one of finite elements of
  /// the same impedance and four times its wave speed; 20 x 2 mm each.
  Scene::Scene
  scene_of_impact(const double stiffness)
  {
    constexpr double length = 0.02;
    Scene::Scene     scene  = SPH::scene_of_block(100, 10, length / 100, 0.);
    auto            &food   = scene.particle_bodies[0];
    food.initial_velocity   = {0.1, 0.};
    food.material.density   = 1000.;
    food.material.youngs_modulus = 1e7;
    food.material.law            = "linear";
    food.solid.viscosity         = "off";
    Scene::PlateBody bar;
    bar.name                       = "bar";
    bar.shape.lower_corner         = {length, 0.};
    bar.shape.upper_corner         = {2. * length, 0.1 * length};
    bar.deformation.elastic        = true;
    bar.deformation.response       = "dynamic";
    bar.deformation.cell_size      = length / 60;
    bar.deformation.density        = 250.;
    bar.deformation.youngs_modulus = 4e7;
    scene.plate_bodies.push_back(bar);
    scene.contact_pairs.push_back({"block", "bar"});
    scene.contact.friction  = 0.;
    scene.contact.stiffness = stiffness;
    return scene;
  }


  struct Impact
  {
    double plateau, impulse, energy_error = 0., momentum_error = 0.;
  };


  Impact
  run_impact(const double stiffness)
  {
    const Scene::Scene scene = scene_of_impact(stiffness);
    RunLog             log("", true, false);
    Bite               bite(scene, MPI_COMM_SELF, log);
    Impact             impact{};
    const auto         momentum = bite.momentum();
    double             first = 0., sum = 0., weight = 0.;
    for (bite.evaluate(); bite.time() < 3e-4; bite.evaluate())
      {
        const auto   e     = bite.energies();
        const double total = e.stored() + e.dissipated();
        if (first == 0.)
          first = total;
        impact.energy_error =
            std::max(impact.energy_error, std::abs(total / first - 1.));
        impact.momentum_error =
            std::max(impact.momentum_error,
                     (bite.momentum() - momentum).norm() / momentum.norm());
        const double force = bite.get_plates()[0].force()[0];
        impact.impulse += force * bite.time_step();
        if (bite.time() > 3e-5 && bite.time() < 8e-5)
          {
            sum += force;
            weight += 1.;
          }
        bite.advance();
      }
    impact.plateau = sum / weight;
    return impact;
  }


  struct Held
  {
    double time_step, impulse = 0., largest = 0., energy_error = 0.,
                      momentum_error = 0.;
  };


  /// Until the food has bounced off.
  Held
  run_held(const Scene::Scene &scene)
  {
    RunLog log("", true, false);
    Bite   bite(scene, MPI_COMM_SELF, log);
    Held   result{bite.time_step()};
    bite.evaluate();
    Measure::EnergyLedger   ledger(bite.energies());
    Measure::MomentumLedger momentum(bite.momentum(),
                                     bite.masses_times_speeds());
    for (; bite.time() < 5e-4; bite.evaluate())
      {
        const double force = bite.get_plates()[0].force()[0];
        result.impulse += force * bite.time_step();
        result.largest = std::max(result.largest, force);
        ledger.record(bite.energies(), force);
        momentum.record(
            bite.momentum(), bite.masses_times_speeds(), bite.impulses());
        bite.advance();
      }
    result.energy_error   = ledger.largest_error();
    result.momentum_error = momentum.largest_error();
    return result;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(elastic_plate)

BOOST_AUTO_TEST_CASE(uniform_pressure_crosses_the_contact_exactly)
{
  constexpr double           width = 0.01, height = 0.004, depth = 1e-6;
  constexpr unsigned int     n  = 20;
  constexpr double           dp = width / n;
  const auto                 x  = sunk_row(n, dp, depth);
  std::vector<Motion>        motion(n, {0., 0., 0., 0.});
  Contact::ContactParameters law;
  law.friction = 0.;
  for (const unsigned int cells : {3u, 7u, 20u, 47u})
    for (const unsigned int degree : {1u, 2u})
      {
        auto body =
            make_rectangle({0., -height}, {width, 0.}, cells, 4, 0., degree);
        auto surface = Contact::polyline_surface(
            "body", body->surface_nodes(), body->surface_facets());

        // What sharing each force at its foot alone would give.
        auto at_foot = surface;
        Contact::GapPenalty(law, row_of(dp), {})
            .compute(x, motion, n, 1e-7, at_foot);
        const auto by_foot = body->factorise(1., 0.).solve(
            body->trace().transpose() * Jaw::nodal_forces(at_foot));
        const double foot_error =
            stress_error(*body, by_foot, 1e7 * depth / dp);

        Jaw::QuasiStaticDeformation deformation(std::move(body), MPI_COMM_SELF);
        Contact::AveragedGap        contact(law, row_of(dp), {});
        contact.compute(x, motion, n, 1e-7, surface);
        unsigned int rounds = 0;
        while (!deformation.settle(surface, {&contact.touches()}, 1e-7))
          {
            for (auto &f : surface.force)
              f = 0.;
            contact.compute_again(motion, 1e-7, surface);
            BOOST_REQUIRE(++rounds < 10u);
          }
        const double pressure = depth / (dp / 1e7 + height / 1e7);
        const double error    = stress_error(
            deformation.get_body(), deformation.displacement(), pressure);
        BOOST_TEST_MESSAGE(cells << " cells of degree " << degree << " under "
                                 << n << " particles: stress wrong by " << error
                                 << ", with forces at the foot by "
                                 << foot_error << "; " << rounds << " rounds");
        if (degree == 1)
          BOOST_TEST(error < 1e-8);
        const double u = depth - pressure * dp / 1e7;
        BOOST_TEST(deformation.strain_energy() ==
                       0.5 * pressure * width * 0.01 * u,
                   tt::tolerance(degree == 1 ? 1e-8 : 5e-3));
      }
}


BOOST_AUTO_TEST_CASE(shared_forces_are_equal_opposite_and_of_the_energy)
{
  const auto body    = make_rectangle({0., -0.004}, {0.01, 0.}, 13, 3, 0.3, 1);
  auto       surface = Contact::polyline_surface(
      "body", body->surface_nodes(), body->surface_facets());
  std::mt19937                           generator(5);
  std::uniform_real_distribution<double> along(-2e-4, 0.0102),
      height(-1e-4, 2.5e-4);
  constexpr double              dp = 5e-4;
  std::vector<dealii::Point<2>> x;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const double a = along(generator);
      x.emplace_back(a, height(generator));
    }
  std::vector<Motion>        motion(x.size(), {0., 0., 0., 0.});
  Contact::ContactParameters law;
  law.friction = 0.;
  Contact::AveragedGap contact(law, row_of(dp), {});
  const auto forces = contact.compute(x, motion, x.size(), 1e-7, surface);

  auto   net  = surface.total_force();
  double size = 0., moment = 0.;
  for (unsigned int k = 0; k < surface.nodes.size(); ++k)
    moment += surface.nodes[k][0] * surface.force[k][1] -
              surface.nodes[k][1] * surface.force[k][0];
  for (const auto &f : forces)
    {
      net += f.force;
      size += f.force.norm();
      moment += x[f.particle][0] * f.force[1] - x[f.particle][1] * f.force[0];
    }
  BOOST_TEST(forces.size() > 100u);
  BOOST_TEST(net.norm() < 1e-14 * size);
  BOOST_TEST(std::abs(moment) < 1e-14 * size * 0.01);

  // Particles and nodes both feel the derivative of the energy.
  constexpr double step   = 1e-9;
  double           worst  = 0.;
  const auto       energy = [&] {
    Contact::Surface copy = surface;
    contact.compute_again(motion, 1e-7, copy);
    return contact.stored_energy();
  };
  const auto nodal   = surface.force;
  double     largest = 0.;
  for (const auto &f : nodal)
    largest = std::max(largest, f.norm());
  for (unsigned int k = 0; k < surface.nodes.size(); ++k)
    if (surface.nodes[k][1] == 0. && surface.nodes[k][0] > 0. &&
        surface.nodes[k][0] < 0.0099)
      {
        double e[2];
        for (const int sign : {0, 1})
          {
            surface.nodes[k][1] = sign == 0 ? -step : step;
            e[sign]             = energy();
          }
        surface.nodes[k][1] = 0.;
        worst               = std::max(worst,
                         std::abs(-(e[1] - e[0]) / (2. * step) - nodal[k][1]));
      }
  BOOST_TEST_MESSAGE("nodal forces differ from the energy's derivative by "
                     << worst / largest);
  BOOST_TEST(worst < 1e-4 * largest);
}


BOOST_AUTO_TEST_CASE(stiff_bars_leave_the_food_its_step)
{
  // A bar that is held behind answers the food's hit. The lighter it is, the
  // smaller a step its mass needs on the springs of contact; with beta = 1/2
  // its stiffness carries them, being more than that of the contact. Same
  // impulse, momentum and energy exact.
  double last_ratio = 1.;
  for (const double lighter : {1., 10., 100.})
    {
      Held       runs[2];
      const bool stiff[] = {false, true};
      for (const bool carried : stiff)
        {
          Scene::Scene scene    = scene_of_impact(1.);
          auto        &bar      = scene.plate_bodies[0].deformation;
          bar.held_sides        = "right";
          bar.density           = 250. / lighter;
          bar.youngs_modulus    = 4e10;
          bar.beta              = carried ? 0.5 : 0.25;
          runs[carried ? 1 : 0] = run_held(scene);
        }
      const double ratio = runs[1].time_step / runs[0].time_step;
      BOOST_TEST_MESSAGE(
          "bar of density "
          << 250. / lighter << ": steps longer by " << ratio
          << ", impulse changes by " << runs[1].impulse / runs[0].impulse - 1.
          << ", force by at most " << runs[1].largest / runs[0].largest - 1.
          << "; energy within " << runs[0].energy_error << " and "
          << runs[1].energy_error << ", momentum within "
          << runs[1].momentum_error);
      BOOST_TEST(ratio > 0.99 * last_ratio);
      BOOST_TEST(runs[1].impulse == runs[0].impulse, tt::tolerance(0.01));
      for (const Held &run : runs)
        {
          BOOST_TEST(run.energy_error < 0.01);
          BOOST_TEST(run.momentum_error < 1e-11);
        }
      last_ratio = ratio;
    }
  BOOST_TEST(last_ratio > 3.5);
}


BOOST_AUTO_TEST_CASE(impact_of_bars_keeps_momentum_and_energy)
{
  // rho c A v/2 while a wave runs to and fro in the shorter time.
  constexpr double force = 1e5 * 2e-5 * 0.05, impulse = force * 1e-4;
  const Impact     soft = run_impact(1.), hard = run_impact(10.);
  for (const auto *const impact : {&soft, &hard})
    {
      BOOST_TEST_MESSAGE("force over rho c A v/2 "
                         << impact->plateau / force
                         << ", impulse over that of the theory "
                         << impact->impulse / impulse << ", energy within "
                         << impact->energy_error << ", momentum within "
                         << impact->momentum_error);
      BOOST_TEST(impact->plateau == force, tt::tolerance(0.01));
      // The contact's springs, a spacing long, let go a little later.
      BOOST_TEST(impact->impulse == impulse,
                 tt::tolerance(impact == &soft ? 0.01 : 0.005));
      BOOST_TEST(impact->energy_error < 0.01);
      BOOST_TEST(impact->momentum_error < 1e-11);
    }
  BOOST_TEST_MESSAGE("a penalty ten times as hard changes the force by "
                     << hard.plateau / soft.plateau - 1.);
  BOOST_TEST(hard.plateau == soft.plateau, tt::tolerance(0.02));
}


BOOST_AUTO_TEST_SUITE_END()
