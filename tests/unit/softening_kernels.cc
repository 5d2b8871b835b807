// Proves: particles that soften by groups soften as the law has each of them,
// and give up the energy that they store less of afterwards.
#include "patch_body.h"

#include <morsel/materials/damage.h>

#include <boost/test/unit_test.hpp>

using namespace Morsel;
using namespace Morsel::SPH;

namespace
{
  struct SofteningBody : PatchBody
  {
    SofteningBody(const bool linear_law, const std::string &driver)
        : PatchBody(13, 9, linear_law)
        , law(parameters(driver), material, 101.2e3, {1e-8, spacing})
    {
      cut(4.5 * spacing, 6.5 * spacing);
      std::mt19937                           generator(5);
      std::uniform_real_distribution<double> uniform(0., 1.);
      p.modulus.resize(p.n_owned);
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const auto &X      = p.reference[i];
          p.motion[i]        = {3e-3 * uniform(generator) * X[1],
                                6e-3 * X[1] - 3e-3 * uniform(generator) * X[0],
                                0.,
                                0.};
          p.half_velocity[i] = {uniform(generator), uniform(generator)};
          p.acceleration[i]  = {1e4 * uniform(generator),
                                1e4 * uniform(generator)};
          p.damage[i]        = 0.9 * uniform(generator);
          p.near_face[i]     = uniform(generator) < 0.3;
          p.modulus[i]       = 0.8 + 0.4 * uniform(generator);
          threshold.push_back(0.5 + uniform(generator));
          used.push_back(0.9 * uniform(generator));
        }
      strain();
    }

    static Materials::DamageParameters
    parameters(const std::string &driver)
    {
      Materials::DamageParameters parameters;
      parameters.flaws           = "uniform";
      parameters.driver          = driver;
      parameters.fracture_energy = 4.;
      return parameters;
    }

    BondedConstants
    constants_of_law() const
    {
      BondedConstants c  = constants();
      c.von_mises_d      = law.von_mises_d;
      c.von_mises_P      = law.von_mises_P;
      c.tensile_strength = law.tensile_strength;
      c.poissons_ratio   = material.poissons_ratio;
      c.youngs_modulus   = material.youngs_modulus;
      c.extension_scale  = law.extension_scale;
      return c;
    }

    /// What a damage of one takes away, mean of both ends of the step [J].
    double
    released(const unsigned int i) const
    {
      double sum = 0.;
      for (const LocalStrain &end : strain_over_step(p, bonds, i, step))
        {
          const auto response = response_to(end.gradient, material, linear_law);
          const auto stored   = [&](const double damage) {
            return Materials::stored_energy(
                law.softening, material, response, damage);
          };
          sum += p.volume(i) * (stored(0.) - stored(1.)) +
                 hourglass_stiffness * end.residual;
        }
      return 0.5 * p.modulus_factor(i) * sum;
    }

    Materials::Softened
    alone(const unsigned int i) const
    {
      const auto   response = response_at(p, material, linear_law, i);
      const double energy =
          p.modulus_factor(i) *
          (response.deviatoric_energy +
           (response.jacobian < 1. ? 0. : response.volumetric_energy));
      return Materials::energy_softening(law,
                                         material,
                                         p.effective[i],
                                         !p.near_face[i],
                                         threshold[i],
                                         energy,
                                         {p.damage[i], used[i]},
                                         p.modulus_factor(i));
    }

    static constexpr double step = 1e-6;

    Materials::DamageLaw law;
    std::vector<double>  threshold, used;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(softening_kernels)

BOOST_AUTO_TEST_CASE(groups_soften_as_their_particles_do)
{
  using boost::test_tools::tolerance;
  for (const char *const driver :
       {"tensile stress", "extension strain", "modified von Mises"})
    for (const bool linear_law : {false, true})
      {
        SofteningBody      body(linear_law, driver);
        const BondedArrays arrays    = bonded_arrays(body.p, body.bonds);
        unsigned int       n_softens = 0, n_fails = 0, n_stays = 0;
        for (unsigned int g = 0; g < body.p.n_groups(); ++g)
          {
            AveragedStress stress{};
            GroupSoftening state{};
            state.half_velocity = body.p.half_velocity.data();
            state.time_step     = body.step;
            for (unsigned int l = 0; l < group_size; ++l)
              {
                const unsigned int i =
                    std::min(g * group_size + l, body.p.n_owned - 1);
                stress.xx[l]       = body.p.effective[i].xx;
                stress.yy[l]       = body.p.effective[i].yy;
                stress.xy[l]       = body.p.effective[i].xy;
                stress.zz[l]       = body.p.effective[i].zz;
                state.threshold[l] = body.threshold[i];
                state.used[l]      = body.used[i];
                state.range[l] =
                    l == 3 ? 0.
                           : body.law.range_at(body.threshold[i],
                                               body.p.modulus_factor(i));
              }
            const bool any =
                pair_kernels()
                    .soften[static_cast<int>(body.law.driver)][linear_law](
                        arrays, body.constants_of_law(), g, stress, state);
            for (unsigned int l = 0; l < group_size; ++l)
              {
                const unsigned int i = g * group_size + l;
                if (i >= body.p.n_owned)
                  continue;
                Materials::Softened alone = body.alone(i);
                if (l == 3)
                  alone = {body.p.damage[i], body.used[i]};
                // Newton's method ends where the strength is met to 1e-10.
                BOOST_TEST(state.damage[l] == alone.damage, tolerance(1e-8));
                BOOST_TEST(state.used[l] == alone.used, tolerance(1e-8));
                const bool softens = alone.damage > body.p.damage[i];
                n_fails += softens && alone.damage == 1.;
                n_softens += softens && alone.damage < 1.;
                n_stays += !softens;
                if (!softens)
                  continue;
                BOOST_TEST(any);
                BOOST_TEST(state.released[l] == body.released(i),
                           tolerance(1e-10));
              }
          }
        BOOST_TEST_MESSAGE(driver << (linear_law ? ", linear" : "") << ": "
                                  << n_softens << " soften, " << n_fails
                                  << " fail, " << n_stays << " stay");
        BOOST_TEST(n_softens > 10);
        BOOST_TEST(n_stays > 10);
      }
}

BOOST_AUTO_TEST_SUITE_END()
