// Proves: a body that breaks on several ranks breaks as on one: the same
// particles fail, at the same steps, the same bonds are cut, damage, motion,
// energies and fragments agree to round-off, momentum is kept, and so it is
// where grains of one rank meet those of another. The tests hold on any number
// of ranks; ctest runs them on 2 and 3.
#include <morsel/core/gather.h>
#include <morsel/core/state_archive.h>
#include <morsel/measure/breakage.h>
#include <morsel/measure/whole_body.h>

#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <set>

using namespace Morsel;

namespace
{
  constexpr unsigned int n       = 20;
  constexpr double       spacing = 5e-4;

  using Velocity = dealii::Tensor<1, 2> (*)(const dealii::Point<2> &);


  /// The two halves of a block part at 3 m/s; the particles of each differ.
  dealii::Tensor<1, 2>
  tearing(const dealii::Point<2> &x)
  {
    const double half = 0.5 * n * spacing;
    return dealii::Tensor<1, 2>(
        {0.2 * std::sin(700. * x[1]), (x[1] > half ? 3. : -3.) + 20. * x[0]});
  }


  /// Columns that run through each other, and a blow from above.
  dealii::Tensor<1, 2>
  crushing(const dealii::Point<2> &x)
  {
    const double half = 0.5 * n * spacing;
    return dealii::Tensor<1, 2>(
        {8. * std::sin(900. * x[1]),
         -12. * (x[1] - half) / half + 6. * std::cos(1100. * x[0])});
  }


  /// @param scatter of the particles, which then take the conforming gradient
  Scene::Scene
  scene(const std::string &growth, const double scatter = 0.)
  {
    Scene::Scene scene          = SPH::scene_of_block(n, n, spacing, 0.3);
    auto        &body           = scene.particle_bodies.front();
    body.scatter                = scatter;
    body.damage.enabled         = true;
    body.damage.growth          = growth;
    body.damage.weibull_modulus = 8.;
    return scene;
  }


  void
  set_velocities(SPH::Solid &solid, const Velocity velocity)
  {
    const auto &p = solid.get_particles();
    for (unsigned int i = 0; i < p.n_local; ++i)
      {
        const auto v = velocity(p.reference[i]);
        SPH::set_velocity(solid, i, {v[0], v[1]});
      }
  }


  void
  take_step(SPH::Solid &solid, const double dt)
  {
    solid.compute_accelerations(dt);
    solid.add_grain_forces(dt);
    solid.grow_damage(dt);
    solid.advance(dt);
    solid.advance_grains(dt);
  }


  /// Pairs of ids whose bond is cut, of the whole body.
  std::set<std::pair<unsigned long long, unsigned long long>>
  cut_pairs(const SPH::Solid &solid)
  {
    using Pair              = std::pair<unsigned long long, unsigned long long>;
    const auto       &bonds = solid.get_bonds();
    const auto       &p     = solid.get_particles();
    std::vector<Pair> pairs;
    for (unsigned int i = 0; i < bonds.list.n_rows(); ++i)
      for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
           ++k)
        if (!bonds.live[k])
          pairs.emplace_back(p.id[i], p.id[bonds.list.index[k]]);
    std::vector<std::array<unsigned long long, 2>> records;
    for (const Pair &pair : pairs)
      records.push_back({{pair.first, pair.second}});
    std::set<Pair> all;
    for (const auto &r : gather(records, solid.get_host().communicator()))
      all.emplace(r[0], r[1]);
    return all;
  }


  double
  largest_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    BOOST_REQUIRE_EQUAL(a.size(), b.size());
    double largest = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
  }


  std::vector<double>
  coordinates(const SPH::Solid &solid)
  {
    std::vector<double> all;
    for (const auto &m :
         Measure::of_whole_body(solid, solid.get_particles().motion))
      all.insert(all.end(), {m.u_x / spacing, m.u_y / spacing});
    return all;
  }


  double
  whole_energy(const SPH::SolidEnergies &e)
  {
    return e.strain + e.hourglass + e.kinetic + e.granular + e.viscous_heat +
           e.damage_heat + e.bond_heat + e.friction_heat;
  }


  void
  check_equal(const SPH::Solid &solid,
              const SPH::Solid &alone,
              const double      tolerance)
  {
    const auto &p = solid.get_particles(), &q = alone.get_particles();
    const auto  failed = Measure::of_whole_body(solid, p.failed);
    BOOST_TEST((failed == q.failed));
    BOOST_TEST((cut_pairs(solid) == cut_pairs(alone)));
    BOOST_CHECK_SMALL(
        largest_difference(Measure::of_whole_body(solid, p.damage), q.damage),
        tolerance);
    BOOST_CHECK_SMALL(
        largest_difference(coordinates(solid), coordinates(alone)), tolerance);
    BOOST_CHECK_CLOSE(
        solid.failed_share() + 1., alone.failed_share() + 1., 1e-12);

    const auto    e = solid.energies(), f = alone.energies();
    const double  scale = whole_energy(f);
    const double *a = &e.strain, *b = &f.strain;
    for (unsigned int k = 0; k < sizeof(e) / sizeof(double); ++k)
      BOOST_CHECK_SMALL((a[k] - b[k]) / scale, tolerance);

    const auto pieces = Measure::fragments_of(solid, 0.005);
    const auto theirs = Measure::fragments_of(alone, 0.005);
    BOOST_TEST(pieces.count == theirs.count);
    BOOST_TEST((Measure::of_whole_body(solid, pieces.label) == theirs.label));
    BOOST_REQUIRE_EQUAL(pieces.pieces.size(), theirs.pieces.size());
    for (unsigned int k = 0; k < pieces.count; ++k)
      BOOST_CHECK_CLOSE(
          pieces.pieces[k].perimeter, theirs.pieces[k].perimeter, 1e-9);
  }


  /// The body as it is, its particles on other ranks: those at the top
  /// right take @p factor times as much as the others, as is said.
  std::unique_ptr<SPH::Solid>
  shared_out_anew(SPH::Solid         &solid,
                  const Scene::Scene &s,
                  const unsigned int  factor)
  {
    const auto               &p = solid.get_particles();
    std::vector<unsigned int> work(p.n_owned, 1);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      if (p.reference[i][0] + p.reference[i][1] > n * spacing)
        work[i] = factor;
    StateArchive saved;
    solid.exchange_state(saved);
    auto other =
        std::make_unique<SPH::Solid>(s.particle_bodies[0],
                                     s,
                                     MPI_COMM_WORLD,
                                     solid.get_host().work_in_cells(work));
    StateArchive loaded({std::move(saved).buffer()}, MPI_COMM_WORLD);
    other->exchange_state(loaded);
    BOOST_TEST(loaded.at_end());
    return other;
  }


  struct Course
  {
    std::string  growth;
    Velocity     velocity;
    unsigned int n_steps;
    double       least_failed, tolerance;
    double       scatter = 0.;
  };


  void
  follow(const Course &course)
  {
    const Scene::Scene s = scene(course.growth, course.scatter);
    SPH::Solid         solid(s.particle_bodies[0], s, MPI_COMM_WORLD);
    SPH::Solid         alone = SPH::make_solid(s);
    set_velocities(solid, course.velocity);
    set_velocities(alone, course.velocity);
    const double dt = alone.stable_time_step(0.);
    BOOST_CHECK_CLOSE(solid.stable_time_step(0.), dt, 1e-8);
    // By it the contact's share of the step is chosen.
    BOOST_TEST(solid.get_edges().largest.width ==
               alone.get_edges().largest.width);
    BOOST_TEST(solid.get_edges().largest.distance ==
               alone.get_edges().largest.distance);
    const auto   momentum = solid.momentum();
    const double before   = whole_energy(alone.energies());
    double       impulse  = 0.;
    for (const double m : alone.get_particles().mass)
      impulse += m * 3.;
    Measure::Breakage one(alone), several(solid);
    for (unsigned int step = 0; step < course.n_steps; ++step)
      {
        take_step(solid, dt);
        take_step(alone, dt);
        one.follow(step * dt);
        several.follow(step * dt);
      }
    BOOST_TEST(alone.failed_share() > course.least_failed);
    solid.compute_accelerations(dt);
    alone.compute_accelerations(dt);
    check_equal(solid, alone, course.tolerance);
    BOOST_REQUIRE(several.first_failure());
    BOOST_TEST(several.first_failure()->time == one.first_failure()->time);
    BOOST_TEST(several.first_failure()->place.distance(
                   one.first_failure()->place) == 0.);

    const auto m = solid.momentum();
    BOOST_CHECK_SMALL((m.x - momentum.x) / impulse, 1e-13);
    BOOST_CHECK_SMALL((m.y - momentum.y) / impulse, 1e-13);
    BOOST_CHECK_CLOSE(whole_energy(solid.energies()), before, 2.);
  }
} // namespace


BOOST_AUTO_TEST_SUITE(breaking_ranks)

BOOST_AUTO_TEST_CASE(torn_in_two)
{
  follow({"linear softening", &tearing, 150, 0.02, 1e-9});
  // On one rank a change of displacements by one part in 1e15 after the first
  // step changes the damage by 1.6e-9, and one in 1e13 does no more: whether
  // the iteration for D ends or goes on. Ranks round otherwise by as much.
  follow({"energy softening", &tearing, 150, 0.02, 1e-8});
}


BOOST_AUTO_TEST_CASE(grains_of_several_ranks)
{
  follow({"energy softening", &crushing, 150, 0.2, 1e-7});
}


BOOST_AUTO_TEST_CASE(explicit_flaws)
{
  follow({"Grady-Kipp", &tearing, 150, 0.02, 1e-9});
}


BOOST_AUTO_TEST_CASE(scattered_particles_with_the_conforming_gradient)
{
  follow({"energy softening", &tearing, 150, 0.02, 1e-8, 0.2});
  follow({"Grady-Kipp", &crushing, 150, 0.02, 1e-7, 0.2});
}


void
change_ranks(const double scatter)
{
  const Scene::Scene s = scene("energy softening", scatter);
  auto               solid =
      std::make_unique<SPH::Solid>(s.particle_bodies[0], s, MPI_COMM_WORLD);
  SPH::Solid alone = SPH::make_solid(s);
  set_velocities(*solid, &crushing);
  set_velocities(alone, &crushing);
  const double dt = alone.stable_time_step(0.);
  for (unsigned int step = 0; step < 150; ++step)
    {
      take_step(*solid, dt);
      take_step(alone, dt);
      if (step % 40 == 20)
        {
          const double before = solid->get_host().n_owned();
          solid = shared_out_anew(*solid, s, step == 20 ? 20 : step / 20);
          const double moved = solid->get_host().maximum(
              std::abs(before - solid->get_host().n_owned()));
          if (step == 20 && !solid->get_host().is_alone())
            BOOST_TEST(moved > 10.);
        }
    }
  BOOST_TEST(alone.failed_share() > 0.2);
  solid->compute_accelerations(dt);
  alone.compute_accelerations(dt);
  check_equal(*solid, alone, 1e-7);
}


BOOST_AUTO_TEST_CASE(particles_change_ranks)
{
  change_ranks(0.);
}


BOOST_AUTO_TEST_CASE(scattered_particles_change_ranks)
{
  change_ranks(0.2);
}


BOOST_AUTO_TEST_CASE(broken_food_takes_more_work)
{
  const Scene::Scene s     = scene("energy softening");
  SPH::Solid         alone = SPH::make_solid(s);
  set_velocities(alone, &tearing);
  const double dt = alone.stable_time_step(0.);
  for (unsigned int step = 0; step < 150; ++step)
    take_step(alone, dt);
  const auto &p    = alone.get_particles();
  const auto  work = alone.work_of_particles();
  BOOST_REQUIRE_EQUAL(work.size(), p.n_owned);
  unsigned long long of_cells = 0, of_all = 0;
  for (const unsigned int w : alone.get_host().work_in_cells(work))
    of_cells += w;
  for (unsigned int i = 0; i < p.n_owned; ++i)
    {
      of_all += work[i];
      // A grain has no bonds, but neighbours.
      BOOST_TEST(work[i] >= (p.failed[i] ? 50 : 100));
    }
  BOOST_TEST(of_cells == of_all);
}

BOOST_AUTO_TEST_SUITE_END()
