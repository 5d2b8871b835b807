// Proves: failed particles separate what lies on their two sides, live bonds
// hold together exactly the fragments that friends-of-friends finds, energy is
// accounted for when bonds break, nothing heals, and pieces that collide hand
// over momentum and keep their energy.
#include "patch_body.h"

#include <morsel/measure/fragments.h>
#include <morsel/sph/damage_evolution.h>
#include <morsel/sph/granular.h>

#include <boost/test/unit_test.hpp>

#include <map>
#include <numeric>

using namespace Morsel;
using namespace Morsel::SPH;

namespace
{
  Materials::DamageParameters
  uniform_flaws()
  {
    Materials::DamageParameters p;
    p.enabled        = true;
    p.flaws          = "uniform";
    p.average_stress = false;
    // The tests set stresses that no strain energy belongs to.
    p.growth = "linear softening";
    return p;
  }


  struct BreakableBody : PatchBody
  {
    BreakableBody(const unsigned int n,
                  const double       ratio,
                  const bool         conforming = false,
                  const double       scatter    = 0.)
        : PatchBody(n,
                    n,
                    false,
                    scatter,
                    KernelKind::cubic_b_spline,
                    ratio,
                    0.5,
                    conforming)
        , n(n)
        , parameters(uniform_flaws())
        , law(parameters, material, 101.2e3, {p.volume(0), p.spacing})
        , fracture(p,
                   bonds,
                   kernel,
                   material,
                   linear_law,
                   law,
                   constants(),
                   parameters,
                   1.2 * spacing,
                   1)
    {}

    /// Makes these particles fail; returns all that failed.
    std::vector<unsigned int>
    kill(const std::vector<unsigned int> &list)
    {
      for (auto &s : p.effective)
        s = {0., 0., 0., 0.};
      for (const unsigned int i : list)
        p.effective[i] = {1e12, 0., 0., 0.};
      const std::vector<unsigned int> now = fracture.update(1e-6);

      // What pressure they carried goes on in the grains, as of now.
      for (const unsigned int i : now)
        {
          const auto  &H = p.gradient[i];
          const double J = (1. + H.xx) * (1. + H.yy) - H.xy * H.yx;
          if (J < 1.)
            grain_energy +=
                p.volume(i) * Materials::volumetric_energy(material.bulk, J);
        }
      return now;
    }

    /// Component of each live particle over live bonds.
    std::vector<unsigned int>
    components() const
    {
      std::vector<unsigned int> root(p.n_owned);
      std::iota(root.begin(), root.end(), 0u);
      const auto find = [&](unsigned int i) {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      };
      for (unsigned int i = 0; i < p.n_owned; ++i)
        for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
             ++k)
          if (bonds.live[k])
            root[find(i)] = find(bonds.list.index[k]);
      for (unsigned int i = 0; i < p.n_owned; ++i)
        root[i] = find(i);
      return root;
    }

    unsigned int                n;
    Materials::DamageParameters parameters;
    Materials::DamageLaw        law;
    DamageEvolution             fracture;
    double                      grain_energy = 0.; ///< of what has failed [J]
  };


  /// Live particles, and the energy of grains, of a body.
  double
  whole_energy(BreakableBody &body)
  {
    return body.energy() + body.grain_energy;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(fracture)

BOOST_AUTO_TEST_CASE(a_failed_row_separates_its_two_sides)
{
  for (const auto &[ratio, conforming] :
       {std::pair(1.3, false), std::pair(2., false), std::pair(1.3, true)})
    {
      BreakableBody             body(20, ratio, conforming);
      const auto                before = body.bonds.live;
      std::vector<unsigned int> row;
      for (unsigned int x = 0; x < 20; ++x)
        row.push_back(20 * 10 + x);
      BOOST_TEST(body.kill(row).size() == 20u);

      unsigned int across = 0, lost = 0;
      for (unsigned int i = 0; i < body.p.n_owned; ++i)
        for (unsigned int k = body.bonds.list.start[i];
             k < body.bonds.list.start[i + 1];
             ++k)
          {
            const unsigned int j    = body.bonds.list.index[k];
            const bool         live = body.bonds.live[k];
            if (i / 20 == 10 || j / 20 == 10 || (i / 20 < 10) != (j / 20 < 10))
              across += live;
            else
              lost += body.bonds.live[k] != before[k];
          }
      BOOST_TEST(across == 0u);
      BOOST_TEST(lost == 0u);
    }
}


BOOST_AUTO_TEST_CASE(live_bonds_hold_together_what_friends_of_friends_finds)
{
  unsigned int patterns = 0, largest = 0;
  for (const double ratio : {1.3, 1.6, 2.0})
    for (unsigned int seed = 0; seed < 12; ++seed)
      {
        // Every other time with the further pairs of the conforming form.
        BreakableBody                          body(30, ratio, seed % 2 == 1);
        std::mt19937                           generator(seed);
        std::uniform_real_distribution<double> uniform(0., 1.);
        for (int batch = 0; batch < 5; ++batch)
          {
            std::vector<unsigned int> list;
            for (unsigned int i = 0; i < body.p.n_owned; ++i)
              if (!body.p.failed[i] && uniform(generator) < 0.1)
                list.push_back(i);
            body.kill(list);

            std::vector<char> alive(body.p.n_owned);
            for (unsigned int i = 0; i < body.p.n_owned; ++i)
              alive[i] = !body.p.failed[i];
            const std::vector<double> areas(body.p.n_owned,
                                            body.spacing * body.spacing);
            const auto                fragments = Measure::find_fragments(
                dealii::make_array_view(alive),
                Measure::friends(
                    dealii::make_array_view(std::as_const(body.p.reference)),
                    1.2 * body.spacing),
                dealii::make_array_view(std::as_const(body.p.reference)),
                dealii::make_array_view(areas),
                body.spacing,
                0.005);

            // A one-to-one map between the two labellings.
            const auto                  root = body.components();
            std::map<unsigned int, int> label_of;
            std::map<int, unsigned int> root_of;
            unsigned int                wrong = 0;
            for (unsigned int i = 0; i < body.p.n_owned; ++i)
              if (alive[i])
                {
                  const int label = fragments.label[i];
                  wrong +=
                      label_of.emplace(root[i], label).first->second != label;
                  wrong +=
                      root_of.emplace(label, root[i]).first->second != root[i];
                }
            BOOST_TEST_CONTEXT("h/dp " << ratio << ", seed " << seed
                                       << ", batch " << batch)
            BOOST_TEST(wrong == 0u);
            ++patterns;
            largest = std::max<unsigned int>(largest, label_of.size());
          }
      }
  BOOST_TEST_MESSAGE(patterns << " patterns, up to " << largest << " pieces");
  BOOST_TEST(largest > 15u);
}


BOOST_AUTO_TEST_CASE(a_particle_with_too_few_bonds_fails)
{
  // One bond, and two bonds on one line: neither spans the plane.
  for (const unsigned int left : {1u, 2u})
    {
      BreakableBody             body(15, 1.3);
      const unsigned int        centre = 7 * 15 + 7;
      std::vector<unsigned int> list;
      for (unsigned int k = body.bonds.list.start[centre];
           k < body.bonds.list.start[centre + 1];
           ++k)
        {
          const unsigned int j = body.bonds.list.index[k];
          if (j != centre + 1 && (left == 1 || j != centre - 1))
            list.push_back(j);
        }
      const auto failed = body.kill(list);
      BOOST_TEST(body.p.failed[centre] == 1);
      BOOST_TEST(
          (std::find(failed.begin(), failed.end(), centre) != failed.end()));
      for (unsigned int k = body.bonds.list.start[centre];
           k < body.bonds.list.start[centre + 1];
           ++k)
        BOOST_TEST(body.bonds.weight[k] == 0.);
    }
}


BOOST_AUTO_TEST_CASE(energy_is_accounted_for_when_bonds_break)
{
  for (const bool conforming : {false, true})
    for (const double stretch : {-0.05, 0.05})
      {
        BreakableBody body(20, 1.3, conforming, conforming ? 0.2 : 0.);
        body.set_random(0.02);
        for (unsigned int i = 0; i < body.p.n_owned; ++i)
          body.p.motion[i].u_y += stretch * body.p.reference[i][1];
        // Some damage that is there already.
        for (unsigned int i = 0; i < body.p.n_owned; ++i)
          {
            body.p.damage[i] = 0.01 * (i % 60);
            body.p.hourglass[i] *= 1. - body.p.damage[i];
          }
        double       before  = whole_energy(body);
        const double initial = before;
        const auto   heat    = [&] {
          return std::accumulate(
                     body.p.damage_heat.begin(), body.p.damage_heat.end(), 0.) +
                 body.fracture.bond_heat();
        };
        double                                 heat_before = heat(), worst = 0.;
        std::mt19937                           generator(9);
        std::uniform_real_distribution<double> uniform(0., 1.);
        for (int batch = 0; batch < 6; ++batch)
          {
            std::vector<unsigned int> list;
            for (unsigned int i = 0; i < body.p.n_owned; ++i)
              if (!body.p.failed[i] && uniform(generator) < 0.08)
                list.push_back(i);
            body.kill(list);
            const double after = whole_energy(body);
            worst              = std::max(worst,
                             std::abs(after + heat() - before - heat_before) /
                                 initial);
            before             = after;
            heat_before        = heat();
          }
        BOOST_TEST_MESSAGE("failure at stretch "
                           << stretch << ": energy lost in the books " << worst
                           << "; released " << heat_before / initial
                           << ", by cutting bonds "
                           << body.fracture.bond_heat() / initial);
        BOOST_TEST(worst < 1e-13);
        BOOST_TEST(heat_before > 0.);
      }
}


BOOST_AUTO_TEST_CASE(nothing_heals)
{
  BreakableBody                    body(16, 1.3);
  std::mt19937                     generator(10);
  std::normal_distribution<double> normal(0., 40e3);
  auto                             damage = body.p.damage;
  auto                             failed = body.p.failed;
  auto                             weight = body.bonds.weight;
  unsigned int                     worse  = 0;
  for (int k = 0; k < 60; ++k)
    {
      for (auto &s : body.p.effective)
        s = {normal(generator),
             normal(generator),
             normal(generator),
             normal(generator)};
      body.fracture.update(1e-6);
      for (unsigned int i = 0; i < body.p.n_owned; ++i)
        {
          BOOST_REQUIRE(body.p.damage[i] >= damage[i]);
          BOOST_REQUIRE(body.p.damage[i] <= 1.);
          BOOST_REQUIRE(body.p.failed[i] >= failed[i]);
          BOOST_REQUIRE((body.p.failed[i] == 0 || body.p.damage[i] == 1.));
          worse += body.p.damage[i] > damage[i];
        }
      for (unsigned int b = 0; b < weight.size(); ++b)
        {
          BOOST_REQUIRE((body.bonds.weight[b] == weight[b] ||
                         body.bonds.weight[b] == 0.));
          BOOST_REQUIRE(body.bonds.weight[b] ==
                        body.bonds.weight[body.bonds.mirror[b]]);
        }
      damage = body.p.damage;
      failed = body.p.failed;
      weight = body.bonds.weight;
    }
  BOOST_TEST(worse > 100u);
  BOOST_TEST(std::count(failed.begin(), failed.end(), 1) > 10);
}

BOOST_AUTO_TEST_SUITE_END()


namespace
{
  /// Two blocks without common bonds, and one far grain that makes the
  /// granular response take part.
  struct Collision
  {
    Collision(const double friction,
              const double viscosity,
              const double offset)
        : body(1, 1, false)
    {
      body.p = Particles();
      for (unsigned int block = 0; block < 2; ++block)
        for (unsigned int y = 0; y < size; ++y)
          for (unsigned int x = 0; x < size; ++x)
            body.add({(x + block * (size + 6.)) * body.spacing,
                      (y + offset * block) * body.spacing});
      body.add({0., 1.});
      body.complete();
      far = body.p.n_owned - 1;

      body.p.failed[far] = 1;
      // The second block comes as near as a fifth of a spacing.
      for (unsigned int i = size * size; i < far; ++i)
        body.p.motion[i].u_x = -5.8 * body.spacing;

      exposed.assign(body.p.n_owned, 0);
      diameter.assign(body.p.n_owned, body.spacing);
      granular = std::make_unique<Granular>(
          body.p,
          body.bonds,
          body.kernel,
          body.material,
          GranularConstants{friction,
                            viscosity,
                            2. * viscosity,
                            body.material.p_wave_modulus * body.depth},
          exposed,
          diameter);
      granular->take_over({far}, {});
    }

    void
    set_velocity(const unsigned int block, const double v_x, const double v_y)
    {
      for (unsigned int i = block * size * size; i < (block + 1) * size * size;
           ++i)
        {
          body.p.half_velocity[i] = {v_x, v_y};
          body.p.motion[i].v_x    = v_x;
          body.p.motion[i].v_y    = v_y;
        }
    }

    Vector2
    mean_velocity(const unsigned int block) const
    {
      Vector2 sum{0., 0.};
      for (unsigned int i = block * size * size; i < (block + 1) * size * size;
           ++i)
        {
          sum.x += body.p.half_velocity[i].x / (size * size);
          sum.y += body.p.half_velocity[i].y / (size * size);
        }
      return sum;
    }

    /// Distance between the blocks' nearest columns [spacings].
    double
    gap() const
    {
      double right = -1e300, left = 1e300;
      for (unsigned int i = 0; i < far; ++i)
        if (i < size * size)
          right = std::max(right, body.p.position(i)[0]);
        else
          left = std::min(left, body.p.position(i)[0]);
      return (left - right) / body.spacing;
    }

    /// Runs through the collision.
    void
    run(const double time)
    {
      const double dt = 0.2 * body.kernel.h / body.material.wave_speed;
      double       size_of_momentum = 0.;
      for (const Vector2 &v : body.p.half_velocity)
        size_of_momentum += std::hypot(v.x, v.y);
      for (unsigned int k = 0; k * dt < time; ++k)
        {
          body.accelerate();
          granular->add_forces(dt);
          // Velocities at the time of the forces.
          double kinetic = 0., p_x = 0., p_y = 0.;
          for (unsigned int i = 0; i < far; ++i)
            {
              const double  half = k == 0 ? 0. : 0.5 * dt;
              const Vector2 v    = body.p.half_velocity[i];
              kinetic += 0.5 * body.p.mass[i] *
                         (std::pow(v.x + half * body.p.acceleration[i].x, 2) +
                          std::pow(v.y + half * body.p.acceleration[i].y, 2));
              p_x += v.x;
              p_y += v.y;
            }
          const double viscous = viscous_heat(body.leapfrog, body.p);
          last_viscous         = viscous;
          stored               = body.energy() + granular->stored_energy();
          const double energy =
              stored + kinetic + granular->friction_heat() + viscous;
          if (k == 0)
            {
              first     = energy;
              first_p_x = p_x;
              first_p_y = p_y;
            }
          last_kinetic = kinetic;
          smallest_gap = std::min(smallest_gap, gap());
          energy_error = std::max(energy_error, std::abs(energy / first - 1.));
          momentum_error = std::max(
              momentum_error,
              std::hypot(p_x - first_p_x, p_y - first_p_y) / size_of_momentum);
          BOOST_REQUIRE(granular->friction_heat() >= last_heat);
          last_heat = granular->friction_heat();
          body.leapfrog.advance(body.p, dt);
          granular->advance(dt);
        }
    }

    static constexpr unsigned int size = 10;

    PatchBody                 body;
    std::vector<char>         exposed;
    std::vector<double>       diameter;
    std::unique_ptr<Granular> granular;
    unsigned int              far;

    double first = 0., stored = 0., last_kinetic = 0., last_heat = 0.,
           last_viscous = 0.;
    double first_p_x = 0., first_p_y = 0.;
    double smallest_gap = 1e300, energy_error = 0., momentum_error = 0.;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(granular)

BOOST_AUTO_TEST_CASE(blocks_collide_head_on)
{
  Collision c(0., 0., 0.);
  c.set_velocity(0, 2., 0.);
  c.run(1.2e-3);
  const double v_0 = c.mean_velocity(0).x, v_1 = c.mean_velocity(1).x;
  BOOST_TEST_MESSAGE("collision: momentum changed by "
                     << c.momentum_error << ", energy by " << c.energy_error
                     << ", kinetic energy after over before "
                     << c.last_kinetic / c.first << ", restitution "
                     << (v_1 - v_0) / 2. << ", nearest columns "
                     << c.smallest_gap);
  BOOST_TEST(c.momentum_error < 1e-14);
  BOOST_TEST(c.energy_error < 1e-2);
  BOOST_TEST(c.smallest_gap > 0.5);
  BOOST_TEST(c.gap() > 1.05); // apart again: nothing glues
  BOOST_TEST(v_1 - v_0 > 1.);
  BOOST_TEST(v_1 - v_0 <= 2.0001);
}


BOOST_AUTO_TEST_CASE(blocks_rub_and_damp)
{
  Collision c(0.5, 1., 0.3);
  c.set_velocity(0, 2., 1.);
  c.run(1.2e-3);
  BOOST_TEST_MESSAGE("oblique collision: momentum changed by "
                     << c.momentum_error << ", energy by " << c.energy_error
                     << ", friction heat " << c.last_heat / c.first
                     << ", viscous heat " << c.last_viscous / c.first
                     << ", sliding velocity left "
                     << c.mean_velocity(0).y - c.mean_velocity(1).y);
  BOOST_TEST(c.momentum_error < 1e-14);
  BOOST_TEST(c.energy_error < 3e-2);
  BOOST_TEST(c.smallest_gap > 0.5);
  BOOST_TEST(c.last_heat > 0.);
  BOOST_TEST(c.last_viscous > 0.);
  BOOST_TEST(c.mean_velocity(1).y > 0.); // dragged along
  BOOST_TEST(c.mean_velocity(0).y < 1.);
}

BOOST_AUTO_TEST_SUITE_END()
