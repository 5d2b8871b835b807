// The guards on made-up bad states.

#include "../../source/guards.h"
#include "sentences.h"
#include "solid_scene.h"

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace Morsel;

namespace
{
  constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

  const Moment safe{2e-3, 340, 1e-6, 1e-6};


  /// A body with guards over it.
  struct Guarded
  {
    explicit Guarded(const char *law = "neo-Hookean")
        : scene(SPH::scene_of_block(8, 8, 1e-3, 0.3))
    {
      scene.particle_bodies[0].material.law = law;
      body                                  = std::make_unique<SPH::Solid>(
          scene.particle_bodies[0], scene, MPI_COMM_SELF);
      system.bodies       = {{"block", body.get()}};
      system.end_time     = 1.;
      system.communicator = MPI_COMM_SELF;
    }

    std::optional<Finding>
    check() const
    {
      const Guards guards(system);
      const auto   of_particles = guards.check_particles();
      return of_particles ? of_particles : guards.check_contacts();
    }

    SPH::Particles &
    particles()
    {
      return state_of(*body);
    }

    Scene::Scene                scene;
    std::unique_ptr<SPH::Solid> body;
    GuardedSystem               system;
  };


} // namespace

BOOST_AUTO_TEST_SUITE(guards)

BOOST_AUTO_TEST_CASE(a_sound_state_passes)
{
  Guarded           g;
  const Guards      guards(g.system);
  Measure::Energies e;
  BOOST_TEST(!g.check());
  BOOST_TEST(!guards.check_step(safe));
  BOOST_TEST(!guards.check_energy(e, Measure::EnergyLedger(e)));
}


BOOST_AUTO_TEST_CASE(what_is_not_finite_is_named)
{
  for (double Motion::*entry :
       {&Motion::u_x, &Motion::u_y, &Motion::v_x, &Motion::v_y})
    for (const double bad :
         {nan_value, std::numeric_limits<double>::infinity()})
      {
        Guarded g;
        g.particles().motion[17].*entry = bad;
        const auto finding              = g.check();
        BOOST_REQUIRE(finding);
        BOOST_TEST((finding->kind == Finding::Kind::not_finite));
        check_says(sentence(*finding, safe, {}),
                   {"'block'",
                    "not finite",
                    "particle 17, at first at (",
                    "at time 0.002 s, step 340",
                    "the likely cause is "});
      }
}


BOOST_AUTO_TEST_CASE(a_particle_inside_out_is_named)
{
  Guarded g;
  g.particles().gradient[9].xx = -1.5;
  const auto finding           = g.check();
  BOOST_REQUIRE(finding);
  BOOST_TEST((finding->kind == Finding::Kind::inverted));
  check_says(sentence(*finding, safe, {}),
             {"'block' has turned inside out", "particle 9"});

  // The small-strain law may be scaled at will.
  Guarded linear("linear");
  linear.particles().gradient[9].xx = -1.5;
  BOOST_TEST(!linear.check());
}


BOOST_AUTO_TEST_CASE(a_runaway_particle_is_named)
{
  Guarded      g;
  const double c              = g.body->get_material().wave_speed;
  g.particles().motion[3].v_y = -1.99 * c;
  BOOST_TEST(!g.check());
  g.particles().motion[3].v_y = -2.01 * c;
  const auto finding          = g.check();
  BOOST_REQUIRE(finding);
  BOOST_TEST((finding->kind == Finding::Kind::too_fast));
  check_says(sentence(*finding, safe, {}), {"runs away", "particle 3", " m/s"});

  // What the scene throws may be as fast as it is thrown.
  g.system.given_speed = 0.1 * c;
  BOOST_TEST(!g.check());
}


BOOST_AUTO_TEST_CASE(deep_contact_is_named)
{
  Guarded g;
  double  depth     = 0.9e-3;
  g.system.contacts = {{"block", "tooth", [&] { return depth; }, 1e-3}};
  BOOST_TEST(!g.check());
  for (const double d : {1.1e-3, nan_value})
    {
      depth              = d;
      const auto finding = g.check();
      BOOST_REQUIRE(finding);
      BOOST_TEST((finding->kind == Finding::Kind::too_deep));
      check_says(
          sentence(*finding, safe, {}),
          {"Body 'block' is ", "deep in 'tooth'", "'Contact/Stiffness'"});
    }
}


BOOST_AUTO_TEST_CASE(energy_from_nowhere_is_named)
{
  Guarded               g;
  const Guards          guards(g.system);
  Measure::EnergyLedger ledger{Measure::Energies()};
  Measure::Energies     e;
  const double          unit = 100. * guards.noticeable_energy();
  e.external_work            = unit;
  e.strain                   = 1.09 * unit;
  BOOST_TEST(!guards.check_energy(e, ledger));
  for (const double strain : {1.2, 0.85, nan_value})
    {
      e.strain           = strain * unit;
      const auto finding = guards.check_energy(e, ledger);
      BOOST_REQUIRE(finding);
      BOOST_TEST((finding->kind == (std::isfinite(strain)
                                        ? Finding::Kind::energy
                                        : Finding::Kind::not_finite)));
      check_says(sentence(*finding, safe, {}),
                 {std::isfinite(strain) ? "energy ledger does not close"
                                        : "energy is not finite"});
    }
  // First touches may be rough.
  e.external_work = 0.;
  e.strain        = 0.9 * guards.noticeable_energy();
  BOOST_TEST(!guards.check_energy(e, ledger));
}


BOOST_AUTO_TEST_CASE(a_step_that_leads_nowhere_is_named)
{
  Guarded      g;
  const Guards guards(g.system);
  for (const double dt : {0., 1e-13, nan_value, -1.})
    {
      const Moment moment{0., 0, dt, dt};
      const auto   finding = guards.check_step(moment);
      BOOST_REQUIRE(finding);
      check_says(sentence(*finding, moment, {}), {"The time step has become"});
    }
}


BOOST_AUTO_TEST_CASE(the_worst_is_named_first)
{
  Guarded g;
  g.particles().motion[3].v_y  = 1e9;
  g.particles().gradient[5].yy = -3.;
  g.particles().motion[40].u_x = nan_value;
  BOOST_TEST((g.check()->kind == Finding::Kind::not_finite));
  g.particles().motion[40].u_x = 0.;
  BOOST_TEST((g.check()->kind == Finding::Kind::inverted));
}


BOOST_AUTO_TEST_CASE(the_sentence_blames_what_it_knows)
{
  const Finding finding{
      Finding::Kind::too_fast, "It runs", "a load", "lower it"};
  check_says(sentence(finding, {1., 2, 1e-5, 1e-6}, {}),
             {"the time step of 1e-05 s, 10 times", "'Time/Time step'"});
  check_says(sentence(finding, safe, {}),
             {"is a load, or the step of 1e-06 s; lower it"});
  check_says(sentence(finding, safe, {{5e-7, 2.5e-7}, "all is lost"}),
             {"steps down to 2.5e-07 s ended alike",
              "is a load, not the step; lower it; all is lost."});
}

BOOST_AUTO_TEST_SUITE_END()
