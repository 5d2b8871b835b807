// Proves: the mesh of a tooth is put where the scene says, bodies are told
// apart by their outlines, tractions have the sum of the forces, contact is
// smooth on facetted cusps and right at sharp ones, and a cusp driven into a
// block keeps momentum and energy.
#include "../../source/bite.h"
#include "solid_scene.h"

#include <morsel/contact/gap_penalty.h>
#include <morsel/contact/traction.h>
#include <morsel/scene/mesh.h>
#include <morsel/scene/read.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Morsel;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double pi = dealii::numbers::PI;


  Scene::PlateShape
  shape_of(const std::string &file, const double angle, const Point<2> &shift)
  {
    Scene::PlateShape shape;
    shape.mesh_file  = file;
    shape.mesh_angle = angle;
    shape.mesh_shift = shift;
    shape.complete(MORSEL_SOURCE_DIR "/meshes");
    return shape;
  }


  /// A square of side 2 a about a point, turned by 45 degrees or not.
  Scene::Outline
  square(const Point<2> &middle, const double a, const bool turned)
  {
    Scene::Outline::Loop loop;
    for (unsigned int k = 0; k < 4; ++k)
      {
        const double angle = 0.5 * pi * k + (turned ? 0. : 0.25 * pi);
        loop.corners.push_back(
            middle + a * std::sqrt(2.) *
                         Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
        loop.sides.push_back(0);
      }
    return Scene::Outline({loop}, {"side"});
  }


  ParticleSide
  side_of(const double dp)
  {
    ParticleSide side;
    side.spacing          = dp;
    side.depth            = 0.01;
    side.mass             = 1000. * dp * dp * side.depth;
    side.youngs_modulus   = 1e7;
    side.p_wave_modulus   = 1e7;
    side.smoothing_length = 1.3 * dp;
    return side;
  }


  Contact::ContactParameters
  frictionless()
  {
    Contact::ContactParameters law;
    law.friction = 0.;
    return law;
  }


  /// The force on one particle at a place.
  Tensor<1, 2>
  force_at(Contact::PlateContact &contact,
           Contact::Surface      &surface,
           const Point<2>        &x)
  {
    for (auto &f : surface.force)
      f = 0.;
    const std::vector<Motion> still(1, {0., 0., 0., 0.});
    const auto &forces = contact.compute({x}, still, 1, 1e-7, surface);
    return forces.empty() ? Tensor<1, 2>() : forces[0].force;
  }


  /// A regular polygon inscribed in a circle about the origin: a cusp; or, as a
  /// hole in a square, a fossa.
  Contact::Surface
  circle(const double       radius,
         const unsigned int n_facets,
         const bool         hollow,
         const double       node_spacing)
  {
    std::vector<std::vector<Point<2>>> loops(1);
    for (unsigned int k = 0; k < n_facets; ++k)
      {
        const double angle = (hollow ? -2. : 2.) * pi * k / n_facets;
        loops[0].push_back(radius * Point<2>(std::cos(angle), std::sin(angle)));
      }
    return Contact::polygon_surface("circle", loops, node_spacing);
  }


  /// What a particle feels that goes around a circle at a fixed distance.
  struct Slide
  {
    double jump;  ///< largest change of force over a short step, over the force
    double swing; ///< largest deviation of direction from the circle's [rad]
    double ripple; ///< (largest - smallest) over mean force
  };


  Slide
  slide(Contact::PlateContact &contact,
        Contact::Surface      &surface,
        const double           distance)
  {
    constexpr unsigned int n     = 20000;
    Slide                  slide = {0., 0., 0.};
    Tensor<1, 2>           last;
    double                 least = 1e300, most = 0.;
    for (unsigned int k = 0; k <= n; ++k)
      {
        const double       angle = 0.1 + 0.5 * pi * k / n;
        const Tensor<1, 2> outward({std::cos(angle), std::sin(angle)});
        const auto f = force_at(contact, surface, Point<2>(distance * outward));
        BOOST_REQUIRE(f.norm() > 0.);
        if (k > 0)
          slide.jump = std::max(slide.jump, (f - last).norm() / f.norm());
        slide.swing =
            std::max(slide.swing,
                     std::asin(std::abs(f[0] * outward[1] - f[1] * outward[0]) /
                               f.norm()));
        least = std::min(least, f.norm());
        most  = std::max(most, f.norm());
        last  = f;
      }
    slide.ripple = 2. * (most - least) / (most + least);
    return slide;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(teeth)

BOOST_AUTO_TEST_CASE(a_mesh_is_turned_and_then_shifted)
{
  // Its tip at the origin, 12 mm wide and 7 mm high.
  const auto lower = shape_of("cusp.msh", 0., {0., 0.});
  BOOST_TEST(lower.upper_corner[1] == 0.);
  BOOST_TEST(lower.extent(0) == 0.012);
  BOOST_TEST(lower.extent(1) == 0.007);

  const auto upper = shape_of("cusp.msh", 180., {0.005, 0.01});
  BOOST_TEST(upper.lower_corner[1] == 0.01);
  BOOST_TEST(upper.upper_corner[1] == 0.017);
  BOOST_TEST(upper.lower_corner[0] == -0.001,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(upper.outline().contains({0.005, 0.0101}));
  BOOST_TEST(!upper.outline().contains({0.005, 0.0099}));
  BOOST_TEST(!upper.outline().contains({0., 0.011}));
  BOOST_TEST(upper.outline().area() == lower.outline().area(),
             boost::test_tools::tolerance(1e-12));

  // A quarter turn leads from y to -x.
  const auto quarter = shape_of("cusp.msh", 90., {0., 0.});
  BOOST_TEST(quarter.lower_corner[0] == 0.);
  BOOST_TEST(quarter.upper_corner[0] == 0.007);

  // Sides keep their names, cells their number and area.
  BOOST_TEST(upper.outline().side_named("crown") <
             upper.outline().get_side_names().size());
  const auto corners = upper.cell_corners();
  double     area    = 0.;
  for (unsigned int c = 0; c < corners.size(); c += 4)
    {
      const auto d = corners[c + 3] - corners[c];
      const auto e = corners[c + 2] - corners[c + 1];
      area += 0.5 * std::abs(d[0] * e[1] - d[1] * e[0]);
    }
  BOOST_TEST(area == upper.outline().area(),
             boost::test_tools::tolerance(1e-12));
}


BOOST_AUTO_TEST_CASE(a_rigid_body_has_its_meshs_boundary)
{
  for (const std::string file :
       {"cusp.msh", "../tests/bad_scenes/meshes/two_triangles.msh"})
    {
      Scene::PlateBody body;
      body.name                = "tooth";
      body.shape               = shape_of(file, 30., {0.1, 0.2});
      const double     spacing = 0.003 * body.shape.extent(0);
      const Jaw::Plate plate(body, nullptr, spacing);
      const auto      &surface = plate.surface;
      double           area = 0., length = 0.;
      for (const auto &[first, second] : surface.facets)
        {
          const auto a = surface.nodes[first], b = surface.nodes[second];
          area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
          length += a.distance(b);
          BOOST_TEST(a.distance(b) < (1. + 1e-9) * spacing);
        }
      const auto outline = body.shape.outline();
      double     around  = 0.;
      for (const auto &edge : outline.get_edges())
        around += edge.length();
      BOOST_TEST(length == around, boost::test_tools::tolerance(1e-12));
      // The body lies to the left.
      BOOST_TEST(area == outline.area(), boost::test_tools::tolerance(1e-9));
    }
}


BOOST_AUTO_TEST_CASE(bodies_are_told_apart_by_their_outlines)
{
  const auto big = square({0., 0.}, 1., false);
  // A corner towards an edge; boxes overlap in none of these or in all.
  BOOST_TEST(
      Scene::separation(big, square({2.5, 0.}, 1. / std::sqrt(2.), true)).gap ==
          0.5,
      boost::test_tools::tolerance(1e-9));
  const auto deep =
      Scene::separation(big, square({1.7, 0.}, 1. / std::sqrt(2.), true));
  BOOST_TEST(deep.gap == -0.3, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(deep.where.distance({0.7, 0.}) < 1e-9);
  // Along the diagonal, where the boxes overlap and the bodies do not.
  BOOST_TEST(Scene::separation(square({0., 0.}, 1., true),
                               square({1.2, 1.2}, 1., true))
                     .gap == 1.2 * std::sqrt(2.) - 2.,
             boost::test_tools::tolerance(0.02));
  // One inside of the other: by the deepest point.
  BOOST_TEST(Scene::separation(big, square({0.2, 0.}, 0.5, false)).gap == -0.7,
             boost::test_tools::tolerance(0.02));

  // Food in the fossa of a lower molar, within its box.
  const auto tooth = shape_of("molar_lower.msh", 0., {0., 0.}).outline();
  BOOST_TEST(
      Scene::separation(square({0.003, -0.0005}, 0.0005, false), tooth).gap >
      1e-4);
  BOOST_TEST(
      Scene::separation(square({0.003, -0.0016}, 0.0005, false), tooth).gap <
      -1e-4);
}


BOOST_AUTO_TEST_CASE(a_mandible_is_below_what_lies_on_its_molar)
{
  // Its condyle stands above the food, which lies on the molar.
  const auto             mandible = shape_of("mandible.msh", 0., {0., 0.});
  const Scene::Rectangle food{{0.057, -0.035}, {0.063, -0.03}};
  BOOST_TEST(mandible.upper_corner[1] > 0.004);
  const auto part = mandible.box_before(1, food);
  BOOST_TEST(part.upper_corner[1] == -0.035,
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(part.lower_corner[1] < -0.06);
  BOOST_TEST(part.lower_corner[0] == 0.057);
  // Nothing stands before food in front of the chin.
  const Scene::Rectangle apart{{0.1, -0.035}, {0.11, -0.03}};
  BOOST_TEST(mandible.box_before(1, apart).upper_corner[1] ==
             mandible.upper_corner[1]);
}


BOOST_AUTO_TEST_CASE(tractions_have_the_sum_of_the_forces)
{
  const double dp = 1e-4, depth = 0.01;
  for (const double spacing : {0.5 * dp, 0.37 * dp, 2.3 * dp})
    {
      Scene::PlateBody body;
      body.name            = "tooth";
      body.shape           = shape_of("cusp.msh", 180., {0., 0.});
      auto         surface = Jaw::Plate(body, nullptr, spacing).surface;
      Tensor<1, 2> total;
      for (unsigned int k = 0; k < surface.nodes.size(); ++k)
        if (std::abs(surface.nodes[k][0]) < 2e-3 && k % 3 > 0)
          surface.force[k] = Tensor<1, 2>({std::cos(7. * k), 2. + k % 5});
      const auto t = Contact::traction_of(surface, dp, depth);
      for (unsigned int k = 0; k < surface.nodes.size(); ++k)
        total += depth * surface.tributary[k] * t.vector[k];
      BOOST_TEST((total - surface.total_force()).norm() <
                 1e-12 * surface.total_force().norm());
      const auto load = Contact::load_on(surface, t);
      BOOST_TEST((load.force - surface.total_force()).norm() <
                 1e-12 * load.force.norm());
    }
}


BOOST_AUTO_TEST_CASE(an_even_row_of_particles_makes_an_even_traction)
{
  const double dp = 1e-4, depth = 0.01, gap = -0.1 * dp;
  auto         surface =
      Contact::rectangle_surface("plate", {0., -1e-3}, {4e-3, 0.}, 0.5 * dp);
  Contact::GapPenalty   contact(frictionless(), side_of(dp), {});
  std::vector<Point<2>> x;
  for (unsigned int i = 0; i < 20; ++i)
    x.emplace_back(1e-3 + (i + 0.37) * dp, 0.5 * dp + gap);
  const std::vector<Motion> still(x.size(), {0., 0., 0., 0.});
  contact.compute(x, still, x.size(), 1e-7, surface);
  const double pressure = -gap / dp * 1e7;
  const auto   t        = Contact::traction_of(surface, dp, depth);
  unsigned int inside   = 0;
  for (unsigned int k = 0; k < surface.nodes.size(); ++k)
    if (surface.nodes[k][1] == 0. && surface.nodes[k][0] > 1.2e-3 &&
        surface.nodes[k][0] < 2.8e-3)
      {
        ++inside;
        BOOST_TEST(t.pressure(k) == pressure,
                   boost::test_tools::tolerance(1e-9));
        BOOST_TEST(std::abs(t.shear(k)) < 1e-9 * pressure);
      }
  BOOST_TEST(inside > 25u);
  const auto load = Contact::load_on(surface, t);
  BOOST_TEST(load.centre[0] == 1e-3 + 9.87 * dp,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(load.contact_length == 20. * dp,
             boost::test_tools::tolerance(0.1));
}


BOOST_AUTO_TEST_CASE(a_sharp_tip_pushes_away)
{
  // A needle of 20 degrees that points up: particles in front of its tip
  // lie behind the line of the far flank.
  const double dp = 1e-4, half = 10. * pi / 180.;
  auto         surface = Contact::polygon_surface(
      "needle",
      {{{0., 0.},
                {-5e-3 * std::sin(half), -5e-3 * std::cos(half)},
                {5e-3 * std::sin(half), -5e-3 * std::cos(half)}}},
      0.5 * dp);
  Contact::GapPenalty  rigid(frictionless(), side_of(dp), {});
  Contact::AveragedGap averaged(frictionless(), side_of(dp), {});
  for (Contact::PlateContact *contact :
       {static_cast<Contact::PlateContact *>(&rigid),
        static_cast<Contact::PlateContact *>(&averaged)})
    for (int degrees = 11; degrees <= 169; degrees += 2)
      {
        const Tensor<1, 2> away(
            {std::cos(degrees * pi / 180.), std::sin(degrees * pi / 180.)});
        const auto f = force_at(*contact, surface, Point<2>(0.4 * dp * away));
        BOOST_TEST(f * away > 0.99 * f.norm());
        BOOST_TEST(f.norm() == 0.1 * dp * 1e7 * 0.01,
                   boost::test_tools::tolerance(1e-6));
      }
}


BOOST_AUTO_TEST_CASE(a_particle_slides_smoothly_over_a_facetted_cusp)
{
  const double dp = 1e-4, radius = 6e-4;
  for (const unsigned int n : {24u, 48u, 96u, 192u})
    for (const bool hollow : {false, true})
      {
        const double distance = hollow ? radius - 0.4 * dp : radius + 0.4 * dp;
        auto         surface  = circle(radius, n, hollow, dp);
        Contact::GapPenalty  rigid(frictionless(), side_of(dp), {});
        Contact::AveragedGap averaged(frictionless(), side_of(dp), {});
        const auto           r = slide(rigid, surface, distance);
        const auto           a = slide(averaged, surface, distance);
        BOOST_TEST_MESSAGE(
            (hollow ? "fossa" : "cusp")
            << " of " << n << " facets (" << 2. * pi * radius / n / dp
            << " dp): nearest point: jump " << r.jump << ", swing " << r.swing
            << ", ripple " << r.ripple << "; mean over the width: jump "
            << a.jump << ", swing " << a.swing << ", ripple " << a.ripple);
        // On a cusp the nearest point moves without a step, in a fossa it
        // leaps where facets meet: the force turns by their angle.
        BOOST_TEST(r.jump < (hollow ? 1.05 * 2. * pi / n : 0.02));
        BOOST_TEST(r.swing < 1.05 * pi / n);
        BOOST_TEST(a.jump < (hollow ? 0.3 * 2. * pi / n : 0.02));
      }
}


BOOST_AUTO_TEST_CASE(a_cusp_driven_into_a_block_keeps_momentum_and_energy)
{
  for (const char *damage : {"false", "true"})
    {
      const Scene::Scene scene = Scene::read_scene(
          MORSEL_SOURCE_DIR "/prm/jaw/peanut_cusp.prm",
          {"Body food/Particles/Particles across=24",
           std::string("Body food/Damage/Enabled=") + damage});
      RunLog log("", true, false);
      Bite   bite(scene, MPI_COMM_SELF, log);
      double error = 0., scale = 0., momentum_error = 0., momenta = 0.;
      for (bite.evaluate(); bite.time() < 6e-4; bite.evaluate())
        {
          if (bite.step() % 20 == 0)
            {
              const auto e = bite.energies();
              scale        = std::max(scale, e.largest_term());
              error        = std::max(
                  error,
                  std::abs(e.external_work - e.stored() - e.dissipated()));
              Tensor<1, 2> given;
              for (const auto &impulse : bite.impulses())
                {
                  given += impulse;
                  momenta = std::max(momenta, impulse.norm());
                }
              momentum_error =
                  std::max(momentum_error, (bite.momentum() - given).norm());
              BOOST_REQUIRE_EQUAL(bite.food().inverted_count(), 0u);
            }
          bite.advance();
        }
      BOOST_TEST_MESSAGE("damage " << damage << ": energy within "
                                   << error / scale << ", momentum within "
                                   << momentum_error / momenta);
      BOOST_TEST(error < 0.005 * scale);
      BOOST_TEST(momentum_error < 1e-11 * momenta);
    }
}

BOOST_AUTO_TEST_SUITE_END()
