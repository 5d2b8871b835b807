// Proves: the stresses of both elastic laws are the derivatives of their
// stored energies, damaged or not; neo-Hooke tends to Hooke's law in plane
// strain, does not care for rotations and stays stable in strong compression.
#include <morsel/materials/damage.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace Morsel::Materials;

namespace
{
  const Elasticity material(23.9e6, 0.3, 1088.);

  ElasticResponse
  respond(const bool linear, const Tensor2 &F)
  {
    return linear ? linear_elastic(material, F) : neo_hookean(material, F);
  }


  double
  energy(const bool linear, const Tensor2 &F, const double D)
  {
    return stored_energy(Softening::deviator, material, respond(linear, F), D);
  }


  Tensor2
  first_piola(const bool linear, const Tensor2 &F, const double D)
  {
    const auto s = soften(Softening::deviator, respond(linear, F), D);
    return linear ? Tensor2{s.xx, s.xy, s.xy, s.yy} : piola(F, s);
  }


  Tensor2
  product(const Tensor2 &a, const Tensor2 &b)
  {
    return {a.xx * b.xx + a.xy * b.yx,
            a.xx * b.xy + a.xy * b.yy,
            a.yx * b.xx + a.yy * b.yx,
            a.yx * b.xy + a.yy * b.yy};
  }


  Tensor2
  rotation(const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c, -s, s, c};
  }
} // namespace


BOOST_AUTO_TEST_SUITE(elasticity)

BOOST_AUTO_TEST_CASE(stress_is_the_derivative_of_the_energy)
{
  const Tensor2 states[] = {{1.02, 0.01, -0.03, 1.05},
                            {0.97, 0.02, 0.01, 0.96},
                            {1.3, 0.2, -0.1, 0.9},
                            {0.6, 0.1, 0.05, 0.7},
                            {0.9, -0.3, 0.4, 0.5},
                            {1.2, 0.5, 0., 1.2}};
  for (const bool linear : {false, true})
    for (const double D : {0., 0.3, 0.9})
      for (const Tensor2 &F : states)
        {
          const Tensor2 P                  = first_piola(linear, F, D);
          const double  components[4]      = {P.xx, P.xy, P.yx, P.yy};
          double Tensor2::*const places[4] = {
              &Tensor2::xx, &Tensor2::xy, &Tensor2::yx, &Tensor2::yy};
          for (unsigned int c = 0; c < 4; ++c)
            {
              const double step  = 1e-5;
              Tensor2      above = F, below = F;
              above.*places[c] += step;
              below.*places[c] -= step;
              const double slope =
                  (energy(linear, above, D) - energy(linear, below, D)) /
                  (2. * step);
              BOOST_TEST(std::abs(slope - components[c]) <
                         1e-8 * material.youngs_modulus);
            }
        }
}


BOOST_AUTO_TEST_CASE(hookes_law_in_plane_strain)
{
  const double  e = 1e-3;
  const Tensor2 F{1. + e, 0.4 * e, 0.2 * e, 1. - 0.5 * e};
  const double  tr = 0.5 * e;
  for (const bool linear : {true, false})
    {
      const auto   s = soften(Softening::deviator, respond(linear, F), 0.);
      const double tolerance = (linear ? 1e-12 : 3e-3) * material.mu * e;
      BOOST_TEST(std::abs(s.xx - material.lambda * tr - 2. * material.mu * e) <
                 tolerance);
      BOOST_TEST(std::abs(s.yy - material.lambda * tr + material.mu * e) <
                 tolerance);
      BOOST_TEST(std::abs(s.xy - material.mu * 0.6 * e) < tolerance);
      BOOST_TEST(std::abs(s.zz - material.lambda * tr) < tolerance);
      BOOST_TEST(std::abs(s.zz - material.poissons_ratio * (s.xx + s.yy)) <
                 tolerance);
    }
}


BOOST_AUTO_TEST_CASE(neo_hooke_tends_to_hooke_at_first_order)
{
  double last = 0.;
  for (const double e : {1e-2, 1e-3, 1e-4})
    {
      const Tensor2 F{1. + e, 0.7 * e, -0.2 * e, 1. - 0.4 * e};
      const auto a = soften(Softening::deviator, neo_hookean(material, F), 0.);
      const auto b =
          soften(Softening::deviator, linear_elastic(material, F), 0.);
      const double error = std::hypot(a.xx - b.xx, a.yy - b.yy, a.xy - b.xy) /
                           std::hypot(b.xx, b.yy, b.xy);
      BOOST_TEST_MESSAGE("neo-Hooke against Hooke at strain "
                         << e << ": relative difference " << error);
      BOOST_TEST(error < 3. * e);
      if (last > 0.)
        BOOST_TEST(last / error == 10., boost::test_tools::tolerance(0.1));
      last = error;
    }
}


BOOST_AUTO_TEST_CASE(a_rotation_turns_the_stress_and_keeps_the_energy)
{
  const Tensor2 F{0.8, 0.3, -0.1, 1.1};
  const auto    s = soften(Softening::deviator, neo_hookean(material, F), 0.3);
  for (int k = 0; k < 12; ++k)
    {
      const Tensor2 Q  = rotation(0.1 + 0.5 * k);
      const Tensor2 Qt = rotation(-0.1 - 0.5 * k);
      const auto    t  = soften(
          Softening::deviator, neo_hookean(material, product(Q, F)), 0.3);
      const Tensor2 turned = product(product(Q, {s.xx, s.xy, s.xy, s.yy}), Qt);
      const double  small  = 1e-13 * material.youngs_modulus;
      BOOST_TEST(std::abs(t.xx - turned.xx) < small);
      BOOST_TEST(std::abs(t.xy - turned.xy) < small);
      BOOST_TEST(std::abs(t.yy - turned.yy) < small);
      BOOST_TEST(std::abs(t.zz - s.zz) < small);
      // Isotropy: neither does a rotation before the deformation matter.
      for (const Tensor2 &G : {product(Q, F), product(F, Q)})
        BOOST_TEST(energy(false, G, 0.3) == energy(false, F, 0.3),
                   boost::test_tools::tolerance(1e-12));
      const auto nothing =
          soften(Softening::deviator, neo_hookean(material, Q), 0.);
      BOOST_TEST(std::hypot(nothing.xx, nothing.yy, nothing.xy) < small);
    }
}


BOOST_AUTO_TEST_CASE(compression_stiffens_down_to_a_tenth_of_the_area)
{
  // Confined and all-round compression: the nominal stress grows steadily.
  for (const bool confined : {true, false})
    {
      double last = 0.;
      for (int k = 1; k <= 90; ++k)
        {
          const double J = 1. - 0.01 * k;
          const double s = confined ? J : std::sqrt(J);
          const double P =
              first_piola(false, {confined ? 1. : s, 0., 0., s}, 0.).yy;
          BOOST_TEST(P < last);
          last = P;
        }
    }
}


BOOST_AUTO_TEST_CASE(energy_is_convex_along_every_simple_shear_and_stretch)
{
  // Rank-one convexity: no direction in which the material loses stiffness
  // and a wave would grow, from a tenth of the area to twice it.
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const double                           pi      = std::acos(-1.);
  double                                 weakest = 1e300;
  for (int k = 0; k < 20000; ++k)
    {
      const double  J = 0.1 + 1.9 * uniform(generator);
      const double  r = std::exp(2. * uniform(generator) - 1.);
      const Tensor2 F =
          product(rotation(2. * pi * uniform(generator)),
                  product({std::sqrt(J) * r, 0., 0., std::sqrt(J) / r},
                          rotation(2. * pi * uniform(generator))));
      const double a = 2. * pi * uniform(generator),
                   n = 2. * pi * uniform(generator), step = 1e-3;
      const auto moved = [&](const double t) {
        return Tensor2{F.xx + t * std::cos(a) * std::cos(n),
                       F.xy + t * std::cos(a) * std::sin(n),
                       F.yx + t * std::sin(a) * std::cos(n),
                       F.yy + t * std::sin(a) * std::sin(n)};
      };
      const double curvature =
          (energy(false, moved(step), 0.) - 2. * energy(false, F, 0.) +
           energy(false, moved(-step), 0.)) /
          (step * step);
      weakest = std::min(weakest, curvature / material.mu);
    }
  BOOST_TEST_MESSAGE("smallest curvature over mu: " << weakest);
  BOOST_TEST(weakest > 0.);
}

BOOST_AUTO_TEST_SUITE_END()
