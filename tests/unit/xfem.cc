// Extended finite elements: quadrature, patch tests, exact boundary data,
// reference values, the silent pitfalls, bad input.
#include <morsel/core/errors.h>
#include <morsel/fe/cell_functions.h>
#include <morsel/fe/plate_mesh.h>
#include <morsel/fe/plate_problem.h>
#include <morsel/fracture/tip_fields.h>

#include <deal.II/base/numbers.h>

#include <boost/test/unit_test.hpp>

#include "cracked_plate.h"

#include <array>
#include <cmath>

namespace
{
  using namespace Morsel::FE;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Triangulation;
  using dealii::numbers::PI;
  using Morsel::Fracture::Crack;
  using Morsel::Fracture::CrackTip;
  using Morsel::Fracture::ElasticPlane;


  /// Integral of 1/r over the rectangle from the tip to a corner.
  double
  corner_integral(const double a, const double b)
  {
    return a <= 0. || b <= 0. ? 0.
                              : a * std::asinh(b / a) + b * std::asinh(a / b);
  }


  /// A plate [-1,1]^2 with a crack along the negative x axis, mesh lines
  /// shifted; for prescribed fields.
  struct Square
  {
    Square(const Crack       &crack,
           const unsigned int n,
           const unsigned int degree,
           const double       radius,
           const double       shift = 0.)
        : space(make(triangulation, n, shift),
                {crack},
                std::vector<EnrichmentParameters>(crack.tips().size(),
                                                  enrichment(degree, radius)))
        , material(1., 0.3)
        , problem(space, material)
    {
      space.distribute(
          std::vector<unsigned int>(triangulation.n_active_cells(), degree));
    }

    static Triangulation<2> &
    make(Triangulation<2>  &triangulation,
         const unsigned int n,
         const double       shift)
    {
      make_plate(triangulation,
                 Point<2>(-1, -1),
                 Point<2>(1, 1),
                 n,
                 n,
                 Tensor<1, 2>({shift, 0.5 * shift}));
      return triangulation;
    }

    static EnrichmentParameters
    enrichment(const unsigned int degree, const double radius)
    {
      EnrichmentParameters e;
      e.tip_degree = degree;
      e.radius     = radius;
      return e;
    }

    Triangulation<2> triangulation;
    XFEMSpace        space;
    ElasticPlane     material;
    ElasticProblem   problem;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(xfem)

BOOST_AUTO_TEST_CASE(quadrature_of_the_tip_singularity)
{
  const std::array<Point<2>, 4> corners = {
      {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1), Point<2>(1, 1)}};
  const QuadMap cell(corners);
  for (const Point<2> &tip : {Point<2>(0.5, 0.5),
                              Point<2>(0.5, 1e-8),
                              Point<2>(0., 0.),
                              Point<2>(1. - 1e-8, 0.3),
                              Point<2>(0.9, 1e-3)})
    {
      const Crack crack({tip - Tensor<1, 2>({2., 0.1}), tip}, false, true);
      const auto  q = cut_quadrature(
          cell, cut_into_pieces(cell.polygon(), {crack}), {tip}, 8);
      double area = 0., integral = 0.;
      for (unsigned int i = 0; i < q.points.size(); ++i)
        {
          area += q.weights[i];
          integral += q.weights[i] / q.points[i].distance(tip);
          BOOST_TEST(q.points[i].distance(cell.to_physical(q.reference[i])) <
                     1e-12);
        }
      double exact = 0.;
      for (const double x : {tip[0], 1. - tip[0]})
        for (const double y : {tip[1], 1. - tip[1]})
          exact += corner_integral(x, y);
      BOOST_TEST(area == 1., boost::test_tools::tolerance(1e-10));
      BOOST_TEST(integral == exact, boost::test_tools::tolerance(1e-6));
    }
}

BOOST_AUTO_TEST_CASE(quadrature_with_the_tip_on_an_edge_but_for_round_off)
{
  // A cell of six refinements whose upper edge misses the tip by 1e-18 m.
  const Point<2> tip(0.001, 0.005);
  const double   h = 1e-2 / 13 / 64;
  for (const double top : {0.005 - 1e-18, 0.005, 0.005 + 1e-18})
    {
      const double                  x       = 0.001 - 0.2 * h;
      const std::array<Point<2>, 4> corners = {{Point<2>(x, top - h),
                                                Point<2>(x + h, top - h),
                                                Point<2>(x, top),
                                                Point<2>(x + h, top)}};
      const QuadMap                 cell(corners);
      const auto q    = cut_quadrature(cell, {cell.polygon()}, {tip}, 10);
      double     area = 0.;
      for (unsigned int i = 0; i < q.points.size(); ++i)
        {
          area += q.weights[i];
          BOOST_TEST(q.points[i].distance(tip) > 0.);
        }
      BOOST_TEST(area == h * h, boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_CASE(rigid_separation_is_exact)
{
  // The crack runs through the whole plate; the upper half is moved.
  for (const double height : {0.03, 0., 1e-9, 0.2})
    {
      const Crack crack(
          {Point<2>(-2, height), Point<2>(2, height)}, false, false);
      Square square(crack, 6, 2, 0.);
      square.problem.hold(PlateSide::bottom, 0);
      square.problem.hold(PlateSide::bottom, 1);
      square.problem.prescribe({PlateSide::top},
                               [](const Point<2> &, const Tensor<1, 2> &) {
                                 return Tensor<1, 2>({0.1, 0.2});
                               });
      const auto u = square.problem.solve(SolverKind::multifrontal);
      BOOST_TEST(square.problem.strain_energy(u) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(tension_along_the_crack_is_exact)
{
  const Crack  crack({Point<2>(-2, 0.04), Point<2>(0.1, 0.04)}, false, true);
  Square       square(crack, 7, 2, 0.3);
  const double nu = 0.3; // eps_yy for sigma_yy = 0 in plane strain
  square.problem.prescribe(
      {0, 1, 2, 3}, [&](const Point<2> &p, const Tensor<1, 2> &) {
        return Tensor<1, 2>({p[0], -nu / (1. - nu) * p[1]});
      });
  const auto u = square.problem.solve(SolverKind::multifrontal);
  // U = E'/2 per unit area.
  BOOST_TEST(square.problem.strain_energy(u) ==
                 0.5 * square.material.effective_modulus * 4.,
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(asymptotic_field_as_boundary_data)
{
  for (const double shift : {0., 0.37})
    {
      const Crack crack(
          {Point<2>(-2, 0.01), Point<2>(0.02, 0.01)}, false, true);
      Square         square(crack, 21, 2, 0.5, shift);
      const CrackTip tip = square.space.get_tips()[0];
      square.problem.prescribe({0, 1, 2, 3},
                               [&](const Point<2> &p, const Tensor<1, 2> &) {
                                 return Morsel::Fracture::williams_field(
                                            tip, square.material, 1., 0.5, p)
                                     .value;
                               });
      const auto u      = square.problem.solve(SolverKind::multifrontal);
      auto       result = choose_rings(square.space, 0, 0.);
      evaluate_rings(square.problem, u, result);
      BOOST_TEST(std::abs(result.statistics.mean.mode_I - 1.) < 1e-6);
      BOOST_TEST(std::abs(result.statistics.mean.mode_II - 0.5) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(direct_solvers_agree)
{
  PlateParameters p = edge_crack('a');
  p.degree = p.tip_degree   = 2;
  p.enrichment_radius       = 1e-3;
  const double multifrontal = relative_K(p);
  p.solver                  = "umfpack";
  BOOST_TEST(relative_K(p) == multifrontal, boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(edge_crack_reference_values)
{
  struct Row
  {
    double a, H;
    char   variant;
    double K_I, K_II;
  };
  for (const Row &row : {Row{1e-3, 1e-2, 'a', 1.1496039, -0.0183147},
                         Row{1e-3, 1e-2, 'b', 1.2291704, 0.},
                         Row{1e-3, 1e-2, 'c', 1.2086434, -0.0064738},
                         Row{1e-3, 2e-2, 'a', 1.1807251, -0.0028427},
                         Row{1e-3, 2e-2, 'b', 1.1893598, 0.},
                         Row{2e-3, 1e-2, 'a', 1.368177, -0.056530},
                         Row{4e-3, 1e-2, 'a', 2.160593, -0.160874},
                         Row{4e-3, 3e-2, 'b', 2.111420, 0.}})
    {
      PlateParameters p = edge_crack(row.variant, row.a, row.H);
      use_table_setting(p);
      const auto   k  = solve(p).tips[0].statistics.mean;
      const double K0 = load * std::sqrt(PI * row.a);
      BOOST_TEST_CONTEXT("a " << row.a << " H " << row.H << row.variant)
      {
        BOOST_TEST(std::abs(k.mode_I / K0 - row.K_I) < 2e-5);
        BOOST_TEST(std::abs(k.mode_II / K0 - row.K_II) < 2e-5);
      }
    }
}

BOOST_AUTO_TEST_CASE(centre_crack_reference_values)
{
  struct Row
  {
    double angle;
    char   variant;
    double upper_I, lower_I, upper_II, lower_II;
  };
  const double K0 = load * std::sqrt(PI * 5e-4);
  for (const Row &row :
       {Row{0, 'a', 1.0364731, 1.0364731, 0.0003358, -0.0003358},
        Row{30, 'a', 0.7816611, 0.7841918, 0.4395231, 0.4369816},
        Row{45, 'a', 0.5265850, 0.5318736, 0.5079763, 0.5044074},
        Row{0, 'b', 1.0139461, 1.0139461, 0., 0.},
        Row{30, 'b', 0.7599171, 0.7599171, 0.4374350, 0.4374350},
        Row{45, 'b', 0.5062398, 0.5062398, 0.5047369, 0.5047369}})
    {
      PlateParameters p = centre_crack(row.variant, row.angle);
      use_table_setting(p);
      const auto tips  = solve(p).tips;
      const auto lower = tips[0].statistics.mean,
                 upper = tips[1].statistics.mean;
      BOOST_TEST_CONTEXT("angle " << row.angle << row.variant)
      {
        BOOST_TEST(std::abs(upper.mode_I / K0 - row.upper_I) < 2e-5);
        BOOST_TEST(std::abs(lower.mode_I / K0 - row.lower_I) < 2e-5);
        BOOST_TEST(std::abs(upper.mode_II / K0 - row.upper_II) < 2e-5);
        BOOST_TEST(std::abs(lower.mode_II / K0 - row.lower_II) < 2e-5);
      }
    }
}

BOOST_AUTO_TEST_CASE(pitfalls_1_2_4_5_hanging_nodes)
{
  // Hanging vertices along the crack and about the tip, and vertices where
  // several members of the collection meet. A part of the enrichment that is
  // lost or not conforming costs 15 to 50 % of K, or makes the energy exceed
  // that of the solution, 4.615049e-6 J/m.
  for (const unsigned int refinements : {0, 1, 2, 3, 4})
    {
      PlateParameters p = edge_crack('a');
      p.degree = p.tip_degree = 1;
      p.enrichment_radius     = 2e-4;
      p.cells_x = p.cells_y = 25;
      p.tip_refinements     = refinements;
      p.layers              = 1.;
      const auto   results  = solve(p);
      const double K        = results.tips[0].statistics.mean.mode_I /
                       (load * std::sqrt(PI * 1e-3));
      BOOST_TEST_CONTEXT(refinements << " refinements")
      {
        BOOST_TEST(std::abs(K / 1.1496039 - 1.) < 0.02);
        BOOST_TEST(results.strain_energy < 4.61506e-6);
        BOOST_TEST(results.strain_energy > 4.5e-6);
      }
    }
}

BOOST_AUTO_TEST_CASE(pitfall_3_ramp_at_awkward_positions)
{
  for (const double offset : {-1e-6, 1e-6, -1e-8, 1e-8, 0.})
    {
      PlateParameters p = edge_crack('a');
      p.degree = p.tip_degree = 1;
      p.enrichment_radius     = 6e-4;
      p.cells_x = p.cells_y = 50;
      p.line_shift          = {{offset / 2e-4, offset / 2e-4}};
      BOOST_TEST(std::abs(relative_K(p) / 1.1496039 - 1.) < 5e-3);
    }
}

BOOST_AUTO_TEST_CASE(pitfalls_6_8_crack_along_edges_and_conditioning)
{
  // Even counts put the crack on mesh lines and the tip on a vertex.
  PlateParameters p = edge_crack('a');
  p.degree = p.tip_degree = 2;
  p.enrichment_radius     = 6e-4;
  p.cells_x = p.cells_y = 50;
  const auto results    = solve(p);
  BOOST_TEST(std::abs(results.tips[0].statistics.mean.mode_I /
                          (load * std::sqrt(PI * 1e-3) * 1.1496039) -
                      1.) < 5e-5);
  BOOST_TEST(results.solve.n_dropped_pivots == 0u);
  BOOST_TEST(results.solve.smallest_pivot > 1e-13);
}

BOOST_AUTO_TEST_CASE(pitfall_7_rings)
{
  PlateParameters p = edge_crack('a');
  p.ring_radius     = 1.1e-3; // the tip is 1 mm from the boundary
  BOOST_CHECK_THROW(solve(p), Morsel::InputError);
  p.ring_radius   = 5e-4;
  p.degree        = 2;
  p.tip_degree    = 2;
  const auto thin = solve(p).tips[0];
  BOOST_TEST(!thin.remark.empty());
  BOOST_TEST(thin.rings.size() == 3u);
}

BOOST_AUTO_TEST_CASE(crack_takes_any_position_relative_to_the_mesh)
{
  PlateParameters p = edge_crack('a');
  p.degree = p.tip_degree = 2;
  p.enrichment_radius     = 6e-4;
  p.cells_x = p.cells_y = 25;
  double low = 1e300, high = 0.;
  for (unsigned int i = 0; i < 8; ++i)
    {
      p.line_shift   = {{0.11 * i,
                       i == 5   ? 0.5
                         : i == 6 ? 0.5 + 1e-8
                                  : 0.07 * i}};
      const double K = relative_K(p);
      low            = std::min(low, K);
      high           = std::max(high, K);
    }
  BOOST_TEST(high - low < 1e-3 * 1.1496);
}

BOOST_AUTO_TEST_CASE(adaptive_refinement_reduces_the_error)
{
  PlateParameters p    = edge_crack('a');
  p.degree             = 2;
  p.tip_degree         = 2;
  p.enrichment_radius  = 6e-4;
  p.corner_refinements = 0;
  // The estimate is one of the energy, 4.615049e-6 J/m.
  const double energy = 4.615049e-6;
  const double coarse = std::abs(solve(p).strain_energy - energy);
  p.adaptive_steps    = 4;
  const auto results  = solve(p);
  BOOST_TEST(std::abs(results.strain_energy - energy) < 0.5 * coarse);
  BOOST_TEST(results.estimates.back() < results.estimates.front());
}

BOOST_AUTO_TEST_CASE(bad_plates_are_refused)
{
  using Morsel::InputError;
  const auto refuse = [](const std::string &paths) {
    PlateParameters p = edge_crack('a');
    p.paths           = paths;
    BOOST_CHECK_THROW(check(p), InputError);
  };
  refuse("0.02, 0.005 > 0.03, 0.005");                            // outside
  refuse("0.002, 0.005 > 0.002, 0.005");                          // zero length
  refuse("0, 0.005 > 0.01, 0.005");                               // cuts off
  refuse("0, 0.005 > 0.012, 0.005");                              // tip outside
  refuse("0, 0.005 > 0.004, 0.005; 0.002, 0.004 > 0.002, 0.006"); // overlap
  refuse("0.002, 0.005");                                         // one point
  refuse("a, b > c, d");                                          // no numbers
  PlateParameters p   = edge_crack('a');
  p.enrichment_radius = 0.02;
  BOOST_CHECK_THROW(check(p), InputError);
  p             = edge_crack('b');
  p.traction[2] = "0, 0";
  BOOST_CHECK_THROW(check(p), InputError); // nothing holds it
  p              = edge_crack('a');
  p.upper_corner = Point<2>(0., 0.);
  BOOST_CHECK_THROW(check(p), InputError);
  dealii::ParameterHandler prm;
  p.declare(prm);
  BOOST_CHECK_THROW(prm.enter_subsection("Discretisation");
                    prm.set("Degree", "0"), dealii::ExceptionBase);
}

BOOST_AUTO_TEST_SUITE_END()
