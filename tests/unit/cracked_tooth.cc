// Proves: an elastic body with cracks has the stress intensities of the XFEM
// plate and of the handbook, moves freely without strain, passes on its loads,
// keeps its mass, and cracks of symmetric bodies have no mode II.
#include "cracked_plate.h"

#include <morsel/contact/surface.h>
#include <morsel/fe/elastic_body.h>
#include <morsel/fe/plate_mesh.h>
#include <morsel/fracture/hoop_stress.h>
#include <morsel/jaw/dynamic_deformation.h>

#include <boost/test/unit_test.hpp>

#include <sstream>

using namespace Morsel;

namespace
{
  namespace tt = boost::test_tools;
  using dealii::Point;

  constexpr double side = 0.01;


  FE::ElasticBodyProperties
  properties_of(const unsigned int degree, const bool held)
  {
    FE::ElasticBodyProperties p;
    p.youngs_modulus = 1e7;
    p.poissons_ratio = 0.3;
    p.density        = 1000.;
    p.depth          = 1.;
    p.degree         = degree;
    if (held)
      p.held = {FE::PlateSide::bottom};
    return p;
  }


  /// A plate of 10 mm width with n cells across and a crack of one segment,
  /// whose ends on the boundary are mouths.
  struct CrackedPlate
  {
    unsigned int n = 25, degree = 1, refinements = 0;
    double       height = side;
    bool         held   = true;
    Point<2>     first{0., 0.5 * side}, last{0.1 * side, 0.5 * side};

    FE::ElasticBody
    make() const
    {
      auto mesh = std::make_unique<dealii::Triangulation<2>>(
          dealii::Triangulation<2>::limit_level_difference_at_vertices);
      FE::make_plate(*mesh,
                     {0., 0.},
                     {side, height},
                     n,
                     static_cast<unsigned int>(std::lround(n * height / side)));
      const auto inside = [&](const Point<2> &p) {
        return p[0] > 0. && p[0] < side && p[1] > 0. && p[1] < height;
      };
      const auto crack =
          Fracture::Crack({first, last}, inside(first), inside(last))
              .with_extended_mouths(0.01 * side);
      for (const auto &tip : crack.tips())
        FE::refine_towards(*mesh, tip.position, refinements, 0.5);
      return FE::ElasticBody(
          std::move(mesh), properties_of(degree, held), {{crack}, 0.});
    }

    /// The same for the program of cracked plates, under a traction on the
    /// top.
    FE::PlateParameters
    plate() const
    {
      FE::PlateParameters p = FE::edge_crack('a', 1e-3, height);
      std::ostringstream  path;
      path << first << " > " << last;
      p.paths = path.str();
      for (char &c : p.paths)
        if (c == ' ')
          c = ',';
      const auto sign = p.paths.find(",>,");
      p.paths.replace(sign, 3, " > ");
      p.cells_x            = n;
      p.cells_y            = std::lround(n * height / side);
      p.degree             = degree;
      p.tip_degree         = degree;
      p.smallest_degree    = degree;
      p.corner_refinements = 0;
      p.tip_refinements    = refinements;
      const double cell    = side / n / (1u << refinements);
      p.enrichment_radius =
          std::min(6. * cell,
                   is_embedded() ? first.distance(last) - 3. * cell
                                 : 0.9 * (first.distance(last) + 0.01 * side));
      return p;
    }

    bool
    is_embedded() const
    {
      return first[0] > 0. && first[1] > 0.;
    }
  };


  /// Forces on the surface's nodes of a traction [Pa] on the sides at which
  /// @p on tells so from the outward normal.
  Eigen::VectorXd
  forces_of(
      const FE::ElasticBody &body,
      const std::function<dealii::Tensor<1, 2>(const dealii::Tensor<1, 2> &)>
          &traction)
  {
    const auto     &nodes = body.surface_nodes();
    Eigen::VectorXd f     = Eigen::VectorXd::Zero(2 * nodes.size());
    for (const auto &[first, second] : body.surface_facets())
      {
        const dealii::Tensor<1, 2> edge = nodes[second] - nodes[first];
        const dealii::Tensor<1, 2> outward({edge[1], -edge[0]});
        const auto                 t = traction(outward / outward.norm());
        for (const unsigned int k : {first, second})
          for (unsigned int d = 0; d < 2; ++d)
            f[2 * k + d] += 0.5 * edge.norm() * t[d];
      }
    return f;
  }


  dealii::Tensor<1, 2>
  pull_up(const dealii::Tensor<1, 2> &outward)
  {
    return dealii::Tensor<1, 2>({0., outward[1] > 0.9 ? FE::load : 0.});
  }


  /// Traction of a uniform stress.
  std::function<dealii::Tensor<1, 2>(const dealii::Tensor<1, 2> &)>
  stressed(const double xx, const double yy, const double xy)
  {
    return [=](const dealii::Tensor<1, 2> &n) {
      return dealii::Tensor<1, 2>(
          {xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]});
    };
  }


  /// Under forces in balance a body that nothing holds gets a little mass, so
  /// that its stiffness has an inverse.
  Eigen::VectorXd
  solve(const FE::ElasticBody &body, const Eigen::VectorXd &forces)
  {
    return body.factorise(1., body.is_held() ? 0. : 1e-3)
        .solve(body.trace().transpose() * forces);
  }
} // namespace


BOOST_AUTO_TEST_SUITE(cracked_tooth)

BOOST_AUTO_TEST_CASE(stress_intensity_is_that_of_the_plate)
{
  const CrackedPlate edge, finer{51}, second{25, 2}, refined{13, 1, 2};
  CrackedPlate       embedded{25}, at_held_side{25};
  embedded.first     = {0.0043, 0.0041};
  embedded.last      = {0.0058, 0.0062};
  at_held_side.first = {0.0031, 0.};
  at_held_side.last  = {0.0042, 0.002};
  for (const CrackedPlate &p :
       {edge, finer, second, refined, embedded, at_held_side})
    {
      const auto body      = p.make();
      const auto u         = solve(body, forces_of(body, pull_up));
      const auto K         = body.cracks()->stress_intensity(u);
      const auto reference = FE::solve(p.plate()).tips;
      BOOST_REQUIRE_EQUAL(K.size(), reference.size());
      for (unsigned int t = 0; t < K.size(); ++t)
        {
          const auto   r    = reference[t].statistics.mean;
          const double size = std::hypot(r.mode_I, r.mode_II);
          BOOST_TEST_MESSAGE(
              p.n << " cells across of degree " << p.degree << ", tip " << t
                  << ": K_I " << K[t].mean.mode_I << ", K_II "
                  << K[t].mean.mode_II << ", spread " << K[t].spread.mode_I
                  << "; less the plate's, over its size: "
                  << (K[t].mean.mode_I - r.mode_I) / size << ", "
                  << (K[t].mean.mode_II - r.mode_II) / size
                  << "; smallest opening "
                  << body.cracks()->smallest_opening(u));
          // With degree 2 the polyline's forces are not quite uniform.
          const double allowed = p.degree == 1 ? 1e-6 : 1e-4;
          BOOST_TEST(std::abs(K[t].mean.mode_I - r.mode_I) < allowed * size);
          BOOST_TEST(std::abs(K[t].mean.mode_II - r.mode_II) < allowed * size);
        }
      BOOST_TEST((body.cracks()->smallest_opening(u) > 0.) ==
                 (K[0].mean.mode_I > 0.));
    }
}


BOOST_AUTO_TEST_CASE(edge_crack_in_a_long_plate_agrees_with_the_handbook)
{
  CrackedPlate p{25, 2};
  p.height        = 3. * side;
  p.held          = false;
  p.first         = {0., 1.5 * side};
  p.last          = {0.2 * side, 1.5 * side};
  const auto body = p.make();
  const auto K    = body.cracks()->stress_intensity(
      solve(body, forces_of(body, stressed(0., FE::load, 0.))))[0];
  // Gross 1964, within 0.5 % for a/W up to 0.6 and a plate of any length.
  const double a = 0.2;
  const double Y = 1.12 - 0.231 * a + 10.55 * a * a - 21.72 * a * a * a +
                   30.39 * a * a * a * a;
  const double handbook =
      Y * FE::load * std::sqrt(dealii::numbers::PI * a * side);
  BOOST_TEST_MESSAGE("K_I over the handbook's: "
                     << K.mean.mode_I / handbook
                     << ", K_II over K_I: " << K.mean.mode_II / K.mean.mode_I);
  BOOST_TEST(K.mean.mode_I == handbook, tt::tolerance(5e-3));
  BOOST_TEST(std::abs(K.mean.mode_II) < 1e-6 * K.mean.mode_I);
}


BOOST_AUTO_TEST_CASE(shear_of_a_symmetric_plate_has_no_mode_I)
{
  CrackedPlate p{25};
  p.held          = false;
  const auto body = p.make();
  const auto K    = body.cracks()->stress_intensity(
      solve(body, forces_of(body, stressed(0., 0., FE::load))))[0];
  BOOST_TEST_MESSAGE("K_II " << K.mean.mode_II << ", K_I over it "
                             << K.mean.mode_I / K.mean.mode_II);
  BOOST_TEST(std::abs(K.mean.mode_II) >
             0.5 * FE::load * std::sqrt(dealii::numbers::PI * 1e-3));
  BOOST_TEST(std::abs(K.mean.mode_I) < 1e-6 * std::abs(K.mean.mode_II));
}


BOOST_AUTO_TEST_CASE(mass_motions_and_reactions_are_exact)
{
  for (const CrackedPlate &p :
       {CrackedPlate{25, 1}, CrackedPlate{13, 2}, CrackedPlate{13, 1, 2}})
    {
      const auto            body = p.make();
      const Eigen::VectorXd f    = forces_of(body, pull_up);
      const Eigen::VectorXd u    = solve(body, f);
      const Eigen::VectorXd Ku   = body.stiffness() * u;
      const double          load = FE::load * side;
      for (unsigned int c = 0; c < 2; ++c)
        {
          const Eigen::VectorXd one  = body.uniform(c);
          const double          mass = one.dot(body.mass() * one);
          BOOST_TEST(mass == 1000. * side * side, tt::tolerance(1e-12));
          BOOST_TEST(std::abs(one.dot(body.mass() * body.uniform(1 - c))) <
                     1e-12 * mass);
          BOOST_TEST((body.stiffness() * one).lpNorm<Eigen::Infinity>() <
                     1e-9 * 1e7);
          BOOST_TEST(
              std::abs(body.cracks()->stress_intensity(one)[0].mean.mode_I) <
              1e-8 * 1e7 / std::sqrt(side));
          const double held = one.cwiseProduct(body.held()).dot(Ku);
          BOOST_TEST_MESSAGE("reaction plus load over load: "
                             << (held + (c == 1 ? load : 0.)) / load);
          BOOST_TEST(std::abs(held + (c == 1 ? load : 0.)) < 1e-9 * load);
        }
      BOOST_TEST(u.dot(Ku) == f.dot(body.trace() * u), tt::tolerance(1e-9));
    }
}


BOOST_AUTO_TEST_CASE(a_slow_dynamic_load_gives_the_static_stress_intensity)
{
  const CrackedPlate p{13};
  const auto         still  = p.make();
  const auto         forces = forces_of(still, pull_up);
  const double       K_still =
      still.cracks()->stress_intensity(solve(still, forces))[0].mean.mode_I;
  auto body    = std::make_unique<FE::ElasticBody>(p.make());
  auto surface = Contact::polyline_surface(
      "body", body->surface_nodes(), body->surface_facets());
  auto plain = std::make_unique<dealii::Triangulation<2>>();
  FE::make_plate(*plain, {0., 0.}, {side, side}, p.n, p.n);
  const FE::ElasticBody sound(std::move(plain), properties_of(1, true));
  const double ratio = Jaw::contact_frequency(*body, 1e9, surface.tributary) /
                       Jaw::contact_frequency(sound, 1e9, surface.tributary);

  constexpr unsigned int  steps = 400;
  constexpr double        dt = 2e-5, end = steps * dt;
  Jaw::DynamicDeformation dynamic(
      std::move(body), dealii::Tensor<1, 2>(), 0.25, dt, MPI_COMM_SELF);
  double          work       = 0.;
  Eigen::VectorXd last       = dynamic.displacement();
  Eigen::VectorXd last_force = 0. * forces;
  for (unsigned int step = 0; step <= steps; ++step)
    {
      const double          s = step * dt / end;
      const Eigen::VectorXd f = s * s * (3. - 2. * s) * forces;
      for (unsigned int k = 0; k < surface.nodes.size(); ++k)
        surface.force[k] = dealii::Tensor<1, 2>({f[2 * k], f[2 * k + 1]});
      const Eigen::VectorXd u = dynamic.displacement();
      work +=
          0.5 * (f + last_force).dot(dynamic.get_body().trace() * (u - last));
      last       = u;
      last_force = f;
      dynamic.account(surface, {step == 0 ? 0.5 * dt : dt, {}, {}});
      if (step < steps)
        dynamic.advance(dt);
    }
  const double K = dynamic.get_body()
                       .cracks()
                       ->stress_intensity(dynamic.displacement())[0]
                       .mean.mode_I;
  const double energy = dynamic.strain_energy() + dynamic.kinetic_energy();
  BOOST_TEST_MESSAGE("K_I over the static one "
                     << K / K_still << ", energy over work " << energy / work
                     << ", contact frequency squared over that without a crack "
                     << ratio);
  BOOST_TEST(K == K_still, tt::tolerance(0.01));
  BOOST_TEST(energy == work, tt::tolerance(1e-3));
}


BOOST_AUTO_TEST_CASE(hoop_stress_is_largest_where_it_is_said_to_be)
{
  for (const Fracture::StressIntensity &K : {Fracture::StressIntensity{1., 0.},
                                             {1., 0.5},
                                             {0.2, -1.},
                                             {0., 1.},
                                             {-3., 1.}})
    {
      const auto hoop = Fracture::largest_hoop_stress(K);
      double     best = 0.;
      for (int k = -1800; k <= 1800; ++k)
        {
          const double t = k * dealii::numbers::PI / 1800.;
          const double c = std::cos(0.5 * t);
          best           = std::max(best,
                          c * (std::max(0., K.mode_I) * c * c -
                               1.5 * K.mode_II * std::sin(t)));
        }
      BOOST_TEST(hoop.equivalent == best, tt::tolerance(1e-5));
      BOOST_TEST(hoop.direction * K.mode_II <= 0.);
    }
  BOOST_TEST(Fracture::largest_hoop_stress({0., 1.}).direction ==
                 -std::acos(1. / 3.),
             tt::tolerance(1e-12));
  BOOST_TEST(Fracture::largest_hoop_stress({-1., 0.}).equivalent == 0.);
}

BOOST_AUTO_TEST_SUITE_END()
