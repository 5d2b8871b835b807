// Proves: drives that the food slows keep their energy and follow the laws of
// mechanics, muscles the curves they cite, frames turn as they say, plates stop
// each other, and friction lets go where it should.
#include "../../source/bite.h"
#include "solid_scene.h"

#include <morsel/jaw/drive.h>
#include <morsel/jaw/quasi_static_deformation.h>

#include <morsel/fe/plate_mesh.h>

#include <deal.II/base/numbers.h>

#include <boost/test/unit_test.hpp>

using namespace Morsel;
using namespace Morsel::Jaw;

namespace
{
  namespace tt = boost::test_tools;

  MuscleParameters
  closer()
  {
    MuscleParameters muscle;
    muscle.name          = "closer";
    muscle.origin        = {0.03, 0.05};
    muscle.insertion     = {0.03, -0.01};
    muscle.maximal_force = 1500.;
    muscle.activation    = "0.2";
    return muscle;
  }


  MotionTable
  half_turn()
  {
    MotionTable table;
    for (unsigned int k = 0; k <= 8; ++k)
      {
        const double s = k / 8.;
        table.time.push_back(0.01 * s);
        table.shift_x.push_back(1e-3 * s * s);
        table.shift_y.push_back(-2e-3 * s);
        table.angle.push_back(dealii::numbers::PI * s * s);
      }
    return table;
  }


  struct Slide
  {
    double acceleration, energy_error;
  };


  /// A block on a plate under gravity that leans by @p slope, the tangent of
  /// its angle, ramped up to settle under a damping; its mean acceleration
  /// along the plate over the time after that, over g.
  Slide
  slide(const double slope, const std::string &stick)
  {
    constexpr double g           = 1e4;
    const double     angle       = std::atan(slope);
    Scene::Scene     scene       = SPH::scene_of_block(12, 6, 5e-4, 0.);
    auto            &food        = scene.particle_bodies[0];
    food.material.density        = 1000.;
    food.material.youngs_modulus = 1e7;
    food.material.law            = "linear";
    // Without it sliding with friction flutters by itself (Adams, J. Appl.
    // Mech. 62, 1995), whatever the step.
    food.solid.viscosity = "on";
    Scene::PlateBody ground;
    ground.name               = "ground";
    ground.shape.lower_corner = {-0.05, -1e-3};
    ground.shape.upper_corner = {0.05, 0.};
    scene.plate_bodies.push_back(ground);
    scene.contact_pairs.push_back({"block", "ground"});
    scene.contact.friction = 0.5;
    scene.contact.stick    = stick;
    Scene::Condition gravity;
    gravity.body  = "block";
    gravity.where = "everywhere";
    gravity.kind  = "acceleration";
    // Down at first, then leaning, slowly enough to stay in equilibrium.
    const std::string down  = std::to_string(g * std::cos(angle));
    const std::string along = std::to_string(g * std::sin(angle));
    gravity.value =
        along + "*min(max(t/1e-3 - 1, 0), 1); -" + down + "*min(t/1e-3, 1)";
    scene.conditions.push_back(gravity);
    Scene::Condition damping = gravity;
    damping.kind             = "damping";
    damping.value            = "if(t < 3e-3, 2e4, 0); if(t < 3e-3, 2e4, 0)";
    scene.conditions.push_back(damping);

    RunLog log("", true, false);
    Bite   bite(scene, MPI_COMM_SELF, log);
    bite.evaluate();
    Measure::EnergyLedger ledger(bite.energies());
    const auto            speed = [&] {
      const auto &p   = bite.food().get_particles();
      double      sum = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        sum += p.motion[i].v_x;
      return sum / p.n_owned;
    };
    double first = 0., begin = 0.;
    while (bite.time() < 8e-3)
      {
        bite.advance();
        bite.evaluate();
        ledger.record(bite.energies(), 1.);
        if (first == 0. && bite.time() > 4e-3)
          {
            first = bite.time();
            begin = speed();
          }
      }
    return {(speed() - begin) / (bite.time() - first) / g,
            ledger.error_at_end()};
  }
} // namespace


BOOST_AUTO_TEST_SUITE(drives)

BOOST_AUTO_TEST_CASE(muscles_follow_their_curves)
{
  using F = MuscleFactors;
  BOOST_TEST(F::force_length(1.) == 1.);
  BOOST_TEST(F::force_length(1.45) == std::exp(-0.45), tt::tolerance(1e-12));
  BOOST_TEST(F::passive(0.9) == 0.);
  BOOST_TEST(F::passive(1.6) == 1., tt::tolerance(1e-12));
  BOOST_TEST(F::force_velocity(0.) == 1.);
  BOOST_TEST(F::force_velocity(1.) == 0.);
  // Hill's hyperbola with a/F_0 = 1/4; stretching is twice as steep at 0.
  BOOST_TEST(F::force_velocity(0.25) == 0.375, tt::tolerance(1e-12));
  const double e = 1e-7;
  BOOST_TEST((F::force_velocity(-e) - 1.) / (1. - F::force_velocity(e)) == 2.,
             tt::tolerance(1e-5));
  BOOST_TEST(F::force_velocity(-1e6) == 1.4, tt::tolerance(1e-5));
}


BOOST_AUTO_TEST_CASE(muscle_does_the_work_of_its_path)
{
  // Moment times angle is force times shortening.
  auto parameters   = closer();
  parameters.origin = {0.02, 0.06};
  const Muscle muscle(parameters, {0., 0.});
  const double e    = 1e-6;
  const auto   path = [&](const double angle) {
    Frame jaw;
    jaw.angle = angle;
    return parameters.origin.distance(jaw.place(parameters.insertion));
  };
  const auto state = muscle.at(0., 0.1, 0.);
  BOOST_TEST(state.moment ==
                 -state.force * (path(0.1 + e) - path(0.1 - e)) / (2. * e),
             tt::tolerance(1e-7));
}


BOOST_AUTO_TEST_CASE(force_moves_a_mass)
{
  MotionParameters motion;
  motion.kind  = "force";
  motion.force = {3., -4.};
  motion.mass  = 0.2;
  ForceDrive   drive(motion, MPI_COMM_SELF);
  const double dt = 1e-5;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      drive.add_load(dealii::Tensor<1, 2>({0.3, -0.4}), 0.);
      drive.account(k == 0 ? 0.5 * dt : dt);
      drive.advance(dt);
    }
  BOOST_TEST(drive.position() == 0.5 * 5.5 / 0.2 * 1e-4, tt::tolerance(1e-10));
  BOOST_TEST(drive.at(0.).shift[1] == -0.8 * drive.position(),
             tt::tolerance(1e-12));
}


BOOST_AUTO_TEST_CASE(jaw_let_go_reaches_a_constant_speed)
{
  // Held against its muscles, then let go: Hill's law and the damping set the
  // speed. Muscle work = kinetic energy + damping.
  HingeParameters hinge;
  hinge.release = 1e-3;
  hinge.damping = 0.5;
  HingeDrive   drive(hinge, {closer()}, MPI_COMM_SELF);
  const double dt   = 1e-6;
  double       held = 0.;
  for (unsigned int k = 0; k < 8000; ++k)
    {
      drive.account(k == 0 ? 0.5 * dt : dt);
      if (k == 500)
        held = drive.actuator();
      drive.advance(dt);
    }
  drive.account(dt);
  BOOST_TEST(held == 0.2 * 1500. * 0.03, tt::tolerance(1e-12));
  const double balance = drive.actuator() - 0.5 * drive.rate();
  BOOST_TEST(std::abs(balance) < 0.03 * drive.actuator());
  BOOST_TEST(drive.work() == drive.kinetic_energy() + drive.damped_energy(),
             tt::tolerance(1e-5));
}


BOOST_AUTO_TEST_CASE(measured_motion_turns_about_its_pivot)
{
  MotionParameters motion;
  motion.kind  = "table";
  motion.table = half_turn();
  motion.pivot = {0.01, 0.02};
  const PrescribedMotion course(motion);
  const dealii::Point<2> x(0.03, -0.01);
  BOOST_TEST(course.at(0.).place(x).distance(x) < 1e-15);
  const auto end = course.at(0.02);
  BOOST_TEST(end.place(x).distance(dealii::Point<2>(-0.009, 0.048)) < 1e-12);
  BOOST_TEST(end.velocity_at(x).norm() == 0.);
  const double e = 1e-7, t = 0.0043;
  const auto   slope =
      (course.at(t + e).place(x) - course.at(t - e).place(x)) / (2. * e);
  const auto frame = course.at(t);
  BOOST_TEST((slope - frame.velocity_at(frame.place(x))).norm() < 1e-5);
}


BOOST_AUTO_TEST_CASE(turned_body_yields_as_in_its_own_frame)
{
  const auto make = [] {
    auto mesh = std::make_unique<dealii::Triangulation<2>>();
    FE::make_plate(*mesh, {0., 0.}, {0.01, 0.005}, 8, 4);
    FE::ElasticBodyProperties p;
    p.youngs_modulus = 1e7;
    p.poissons_ratio = 0.3;
    p.density        = 1000.;
    p.held           = {FE::PlateSide::bottom};
    return std::make_unique<QuasiStaticDeformation>(
        std::make_unique<FE::ElasticBody>(std::move(mesh), p), MPI_COMM_SELF);
  };
  Frame turned_frame;
  turned_frame.angle = 0.7;
  const auto      R  = turned_frame.orientation();
  Eigen::VectorXd u[2];
  for (const bool turn : {false, true})
    {
      auto       body    = make();
      const auto nodes   = body->get_body().surface_nodes();
      auto       surface = Contact::polyline_surface(
          "body", nodes, body->get_body().surface_facets());
      Contact::Touches touches;
      // On top, a force and the spring that belongs to it.
      for (unsigned int k = 0; k < nodes.size(); ++k)
        if (nodes[k][1] > 0.0049 && nodes[k][0] < 0.006)
          {
            dealii::Tensor<1, 2> f({3., -10.});
            surface.force[k] = turn ? R * f : f;
            touches.shares.emplace_back(k, 1.);
            touches.list.push_back(
                {{},
                 static_cast<unsigned int>(touches.shares.size() - 1),
                 static_cast<unsigned int>(touches.shares.size())});
          }
      if (turn)
        body->turn(R);
      const auto   then = surface.nodes;
      unsigned int n    = 0;
      while (!body->settle(surface, {&touches}, 1e-6) && ++n < 20)
        ;
      u[turn] = body->displacement();
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          const auto in_frame = turned(turn ? R : Frame().orientation(),
                                       body->get_body().trace() * u[turn],
                                       k);
          BOOST_TEST((surface.nodes[k] - then[k] - in_frame).norm() < 1e-12);
        }
    }
  BOOST_TEST((u[0] - u[1]).norm() < 1e-12 * u[0].norm());
}


BOOST_AUTO_TEST_CASE(plates_stop_each_other)
{
  // A falling plate bounces off another one: nothing is lost in the meeting.
  Scene::Scene     scene = SPH::scene_of_block(8, 8, 1e-3, 0.3);
  Scene::PlateBody ground, hammer;
  ground.name               = "ground";
  ground.shape.lower_corner = {0.02, -0.001};
  ground.shape.upper_corner = {0.03, 0.};
  hammer.name               = "hammer";
  hammer.shape.lower_corner = {0.022, 0.0005};
  hammer.shape.upper_corner = {0.028, 0.002};
  hammer.motion.kind        = "force";
  hammer.motion.force       = {0., -20.};
  hammer.motion.mass        = 0.05;
  scene.plate_bodies        = {ground, hammer};
  scene.plate_pairs         = {{"hammer", "ground"}};
  scene.contact.friction    = 0.;
  RunLog log("", true, false);
  Bite   bite(scene, MPI_COMM_SELF, log);
  bite.evaluate();
  const auto *const     drive   = bite.inertial_drives().front().second;
  double                deepest = 0., highest = 0., error = 0.;
  Measure::EnergyLedger ledger(bite.energies());
  while (bite.time() < 6e-3)
    {
      bite.advance();
      bite.evaluate();
      deepest = std::max(deepest, drive->position());
      if (drive->rate() < 0.)
        highest = drive->position();
      const double on_plates = bite.energies().contact;
      error                  = std::max(
          error, std::abs(drive->work() - drive->kinetic_energy() - on_plates));
    }
  BOOST_TEST(deepest > 5e-4);
  BOOST_TEST(deepest < 7e-4);
  BOOST_TEST(highest < deepest - 1e-4);
  BOOST_TEST(error < 1e-3 * 20. * 5e-4);
}


BOOST_AUTO_TEST_CASE(elastic_bars_swap_their_velocities)
{
  // Two free bars of finite elements: the one that flies stops, the other
  // takes all of its velocity (two passages of the wave).
  Scene::Scene     scene = SPH::scene_of_block(4, 4, 5e-4, 0.);
  Scene::PlateBody flies;
  flies.name                         = "flies";
  flies.shape.lower_corner           = {0.1, 0.};
  flies.shape.upper_corner           = {0.12, 0.002};
  flies.deformation.elastic          = true;
  flies.deformation.response         = "dynamic";
  flies.deformation.cell_size        = 5e-4;
  flies.deformation.density          = 1000.;
  flies.deformation.youngs_modulus   = 1e7;
  flies.deformation.initial_velocity = {0.1, 0.};
  Scene::PlateBody waits             = flies;
  waits.name                         = "waits";
  waits.shape.lower_corner           = {0.12, 0.};
  waits.shape.upper_corner           = {0.14, 0.002};
  waits.deformation.initial_velocity = {0., 0.};
  scene.plate_bodies                 = {flies, waits};
  scene.plate_pairs                  = {{"flies", "waits"}};
  scene.contact.friction             = 0.;
  RunLog log("", true, false);
  Bite   bite(scene, MPI_COMM_SELF, log);
  bite.evaluate();
  const auto            before = bite.momentum();
  Measure::EnergyLedger ledger(bite.energies());
  while (bite.time() < 8e-4)
    {
      bite.advance();
      bite.evaluate();
      ledger.record(bite.energies(), 1.);
    }
  const auto of = [&](const unsigned int p) {
    return bite.get_plates()[p].get_deformation()->momentum()[0];
  };
  BOOST_TEST((bite.momentum() - before).norm() < 1e-12 * before.norm());
  BOOST_TEST(ledger.largest_error() < 0.01);
  BOOST_TEST(std::abs(of(0)) < 0.03 * before[0]);
  BOOST_TEST(of(1) == before[0], tt::tolerance(0.03));
}


BOOST_AUTO_TEST_CASE(bodies_of_particles_push_each_other)
{
  // Two blocks of different spacing side by side, one flies into the other:
  // nothing is pushed at first, momentum is kept to round-off, energy but for
  // what the step costs.
  Scene::Scene scene = SPH::scene_of_block(20, 10, 5e-4, 0.3);
  auto         other = scene.particle_bodies[0];
  scene.particle_bodies[0].initial_velocity = {0.05, 0.};
  other.name                                = "other";
  other.shape.lower_corner                  = {0.01, 0.};
  other.shape.upper_corner                  = {0.02, 0.005};
  other.particles_across                    = 26;
  other.spacing                             = 0.01 / 26;
  scene.particle_bodies.push_back(other);
  scene.food_pairs = {{"block", "other"}};
  RunLog log("", true, false);
  Bite   bite(scene, MPI_COMM_SELF, log);
  bite.evaluate();
  BOOST_TEST(bite.energies().contact == 0.);
  const auto            before = bite.momentum();
  Measure::EnergyLedger ledger(bite.energies());
  double                pressed = 0.;
  while (bite.time() < 4e-4)
    {
      bite.advance();
      bite.evaluate();
      ledger.record(bite.energies(), 1.);
      pressed = std::max(pressed, bite.energies().contact);
    }
  BOOST_TEST(pressed > 0.);
  BOOST_TEST((bite.momentum() - before).norm() < 1e-13 * before.norm());
  BOOST_TEST(ledger.largest_error() < 2e-3);
}


BOOST_AUTO_TEST_CASE(block_on_a_slope_starts_at_the_angle_of_friction)
{
  for (const double share : {0.99, 1.01, 1.5})
    {
      const auto   elastic = slide(0.5 * share, "elastic");
      const double cosine  = std::cos(std::atan(0.5 * share));
      const double theory  = std::max(0., 0.5 * (share - 1.) * cosine);
      BOOST_TEST_INFO("share " << share << " ledger " << elastic.energy_error);
      BOOST_TEST(std::abs(elastic.acceleration - theory) < 1e-4);
      BOOST_TEST(elastic.energy_error < 1e-3);
    }
}

BOOST_AUTO_TEST_SUITE_END()
