// Cracked plates: what no single entry shows, conversions in plane stress, the
// J vector and the two-direction recipe, energy route, the opened crack.
#include <morsel/core/errors.h>
#include <morsel/core/vtu.h>
#include <morsel/fe/plate_problem.h>
#include <morsel/fe/point_values.h>
#include <morsel/fracture/energy_release.h>
#include <morsel/fracture/plate_output.h>
#include <morsel/fracture/tip_fields.h>

#include <deal.II/base/numbers.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

namespace
{
  using namespace Morsel;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Triangulation;
  using dealii::numbers::PI;
  using Fracture::ElasticPlane;

  constexpr double load = 1e3; ///< [Pa]


  FE::PlateParameters
  edge_crack()
  {
    FE::PlateParameters p;
    p.paths       = "0, 0.005 > 0.001, 0.005";
    p.support[2]  = "clamp";
    p.traction[3] = "0, 1000";
    return p;
  }


  /// M2 at 45 degrees.
  FE::PlateParameters
  inclined_crack()
  {
    FE::PlateParameters p = edge_crack();
    p.crack_form          = "inclined";
    p.angle               = 45.;
    p.enrichment_radius   = 3.5e-4;
    p.tip_refinements     = 2;
    return p;
  }


  struct Solved
  {
    explicit Solved(const FE::PlateParameters &parameters)
        : parameters(parameters)
        , cracks(make_cracks(parameters))
        , triangulation(Triangulation<2>::limit_level_difference_at_vertices)
        , problem(parameters, cracks, triangulation)
        , results(problem.run())
    {}

    Fracture::FieldSampler
    sampler() const
    {
      return [this](const std::vector<Point<2>> &points) {
        return FE::sample_points(
            problem.get_problem(), problem.get_solution(), points);
      };
    }

    FE::PlateParameters          parameters;
    std::vector<Fracture::Crack> cracks;
    Triangulation<2>             triangulation;
    FE::PlateProblem             problem;
    const FE::PlateResults      &results;
  };


  /// Integrals of the singular field and a stress T along the crack, with the
  /// energies of the crack's faces.
  Fracture::InteractionIntegral
  integral_of_exact_field(const ElasticPlane &material,
                          const double        K_I,
                          const double        K_II,
                          const double        T)
  {
    const Fracture::CrackTip tip =
        Fracture::Crack({Point<2>(-1., -1.), Point<2>(0., 0.)}, false, true)
            .tips()[0];
    // eps_22 = -lambda/(lambda + 2 mu) eps_11 where sigma_22 = 0.
    Tensor<2, 2> local;
    local[0][0] = T / material.effective_modulus;
    local[1][1] =
        -material.lambda / (material.lambda + 2. * material.mu) * local[0][0];
    const Tensor<1, 2> &d = tip.direction;
    Tensor<2, 2>        turn;
    turn[0][0] = turn[1][1]     = d[0];
    turn[0][1]                  = -d[1];
    turn[1][0]                  = d[1];
    const Tensor<2, 2> uniform  = turn * local * transpose(turn);
    const auto         gradient = [&](const Point<2> &p) {
      return williams_field(tip, material, K_I, K_II, p).gradient + uniform;
    };

    Fracture::InteractionIntegral integral(tip, material, {0.2, 1.});
    constexpr unsigned int        n_r = 200, n_t = 240;
    const auto                    place = [&](const double r, const double t) {
      const double angle = PI / 4. + t;
      return Point<2>(r * std::cos(angle), r * std::sin(angle));
    };
    for (unsigned int i = 0; i < n_r; ++i)
      for (unsigned int j = 0; j < n_t; ++j)
        {
          const double   r = 0.2 + 0.8 * (i + 0.5) / n_r;
          const double   t = PI * ((2. * j + 1.) / n_t - 1.);
          const Point<2> p = place(r, t);
          const auto     H = gradient(p);
          integral.add(p, H, material.stress(H), r * 0.8 / n_r * 2. * PI / n_t);
        }
    constexpr unsigned int n_faces = 2000;
    for (unsigned int i = 0; i < n_faces; ++i)
      {
        const double s = (i + 0.5) / n_faces, r = s * s;
        double       energy[2];
        for (unsigned int side = 0; side < 2; ++side)
          {
            const auto H =
                gradient(place(r, (side == 0 ? 1. : -1.) * (PI - 1e-12)));
            energy[side] =
                0.5 * scalar_product(Tensor<2, 2>(material.stress(H)), H);
          }
        integral.add_faces(r, energy[0] - energy[1], 2. * s / n_faces);
      }
    return integral;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(plates)

BOOST_AUTO_TEST_CASE(conversions_in_plane_strain_and_plane_stress)
{
  const double E = 7., nu = 0.3, K_I = 2., K_II = -0.5;
  for (const bool plane_stress : {false, true})
    {
      const ElasticPlane material(E, nu, plane_stress);
      const double       modulus = plane_stress ? E : E / (1. - nu * nu);
      BOOST_TEST(material.effective_modulus == modulus,
                 boost::test_tools::tolerance(1e-14));
      for (const double T : {0., 3.})
        {
          const auto integral = integral_of_exact_field(material, K_I, K_II, T);
          BOOST_TEST(integral.stress_intensity().mode_I == K_I,
                     boost::test_tools::tolerance(1e-4));
          BOOST_TEST(integral.stress_intensity().mode_II == K_II,
                     boost::test_tools::tolerance(1e-4));
          BOOST_TEST(integral.energy_release_rate() ==
                         (K_I * K_I + K_II * K_II) / modulus,
                     boost::test_tools::tolerance(1e-4));
          // Without the faces T would change J_2.
          BOOST_TEST(integral.energy_release_rate_across() ==
                         -2. * K_I * K_II / modulus,
                     boost::test_tools::tolerance(1e-3));
          const auto K = Fracture::two_direction_recipe(
              integral.energy_release_rate(),
              integral.energy_release_rate_across(),
              material.effective_modulus);
          BOOST_TEST(K.mode_I == K_I, boost::test_tools::tolerance(1e-3));
          BOOST_TEST(K.mode_II == K_II, boost::test_tools::tolerance(1e-3));
        }
    }
}

BOOST_AUTO_TEST_CASE(two_directions_on_a_solved_plate)
{
  FE::PlateParameters p = inclined_crack();
  p.two_directions      = true;
  for (const bool plane_stress : {false, true})
    {
      p.plane_stress = plane_stress;
      const Solved       solved(p);
      const ElasticPlane material(
          p.youngs_modulus, p.poissons_ratio, plane_stress);
      for (const auto &tip : solved.results.tips)
        {
          const auto k = tip.statistics.mean;
          BOOST_TEST(tip.energy_release.back() * material.effective_modulus ==
                         k.mode_I * k.mode_I + k.mode_II * k.mode_II,
                     boost::test_tools::tolerance(1e-4));
          BOOST_TEST(tip.energy_release_across.back() *
                             material.effective_modulus ==
                         -2. * k.mode_I * k.mode_II,
                     boost::test_tools::tolerance(5e-3));
        }
    }
}

BOOST_AUTO_TEST_CASE(energy_route_under_both_kinds_of_load)
{
  // K by displacement control differs, but both routes must agree.
  for (const bool by_displacement : {false, true})
    {
      FE::PlateParameters p = edge_crack();
      p.energy_growth       = 5e-5;
      if (by_displacement)
        {
          p.traction[3]     = "0, 0";
          p.support[3]      = "displacement";
          p.displacement[3] = "0, 1e-6";
        }
      check(p);
      const Solved solved(p);
      const auto   k = solved.results.tips[0].statistics.mean;
      const double K = std::hypot(k.mode_I, k.mode_II);
      BOOST_TEST(k.mode_I > 0.);
      BOOST_TEST(FE::energy_route(p, solved.results.strain_energy) == K,
                 boost::test_tools::tolerance(2e-3));
      BOOST_TEST(solved.results.strain_energy ==
                     solved.problem.get_problem().strain_energy(
                         solved.problem.get_solution()),
                 boost::test_tools::tolerance(1e-9));
    }
  FE::PlateParameters both = edge_crack();
  both.energy_growth       = 5e-5;
  both.support[1]          = "displacement";
  both.displacement[1]     = "1e-6, 0";
  BOOST_CHECK_THROW(check(both), InputError);
}

BOOST_AUTO_TEST_CASE(the_crack_is_open)
{
  const Solved       solved(edge_crack());
  const auto         sample = solved.sampler();
  const double       K_I    = solved.results.tips[0].statistics.mean.mode_I;
  const ElasticPlane material(1e7, 0.3);
  // Near the tip the faces follow the law.
  const double r     = 1e-6;
  const auto   faces = sample(
      {Point<2>(1e-3 - r, 5e-3 + 1e-10), Point<2>(1e-3 - r, 5e-3 - 1e-10)});
  BOOST_TEST(faces[0].value[1] - faces[1].value[1] ==
                 8. * K_I / material.effective_modulus *
                     std::sqrt(r / (2. * PI)),
             boost::test_tools::tolerance(1e-2));
  // Far from the crack there is one value, also on a face between cells.
  const auto far = sample({Point<2>(5e-3, 8e-3), Point<2>(5e-3, 8e-3 + 1e-12)});
  BOOST_TEST((far[0].value - far[1].value).norm() < 1e-9 * far[0].value.norm());
  const std::string table = Fracture::crack_opening_csv(
      solved.parameters, solved.cracks, solved.results.tips, sample);
  BOOST_TEST(table.find("opening [m]") != std::string::npos);
  BOOST_TEST(std::count(table.begin(), table.end(), '\n') > 50);
}

BOOST_AUTO_TEST_CASE(parts_that_nothing_holds)
{
  const auto refused = [](FE::PlateParameters p, const std::string &paths) {
    p.paths = paths;
    try
      {
        check(p);
      }
    catch (const InputError &)
      {
        return true;
      }
    return false;
  };
  FE::PlateParameters one_end = edge_crack();
  FE::PlateParameters both_ends(one_end);
  both_ends.traction[3] = "0, 0";
  both_ends.support[3]  = "clamp";
  FE::PlateParameters rolling(both_ends);
  rolling.support[3]        = "roller";
  const std::string through = "0, 0.005 > 0.01, 0.005";
  BOOST_TEST(refused(one_end, through));
  BOOST_TEST(!refused(both_ends, through));
  BOOST_TEST(refused(rolling, through)); // its half can slide
  BOOST_TEST(refused(both_ends, through + "; 0, 0.007 > 0.01, 0.007"));
  BOOST_TEST(
      refused(both_ends, "0, 0.004 > 0.005, 0.004 > 0.005, 0.006 > 0, 0.006"));
  BOOST_TEST(!refused(both_ends, "0.005, 0.01 > 0.005, 0")); // both are held
  BOOST_TEST(refused(both_ends, "0.01, 0.004 > 0.004, 0.005 > 0.01, 0.006"));
  BOOST_TEST(refused(one_end, "0.004, 0.01 > 0.004, 0.006 > 0, 0.006"));
  BOOST_TEST(!refused(one_end, "0.004, 0 > 0.004, 0.006 > 0, 0.006"));
}

BOOST_AUTO_TEST_CASE(two_tips_in_one_cell)
{
  // 0.6 mm apart in a cell of 0.77 mm: refused; refined, both are right.
  FE::PlateParameters p = edge_crack();
  p.support[2]          = "free";
  p.traction[2]         = "0, -1000";
  p.paths             = "0, 0.005 > 0.0047, 0.005; 0.01, 0.005 > 0.0053, 0.005";
  p.enrichment_radius = 4e-4;
  check(p);
  BOOST_CHECK_THROW(Solved solved(p), InputError);
  p.tip_refinements = 1;
  const Solved fine(p);
  BOOST_TEST(fine.results.tips[0].statistics.mean.mode_I ==
                 fine.results.tips[1].statistics.mean.mode_I,
             boost::test_tools::tolerance(1e-5));
  BOOST_TEST(fine.results.tips[0].statistics.spread.mode_I <
             1e-4 * fine.results.tips[0].statistics.mean.mode_I);
}

BOOST_AUTO_TEST_CASE(rings_keep_off_the_blending_layer_where_there_is_room)
{
  FE::PlateParameters p = edge_crack();
  p.degree = p.tip_degree = 2;
  p.enrichment_radius     = 8e-4;
  p.cells_x = p.cells_y = 51;
  const Solved fine(p);
  BOOST_TEST(fine.results.tips[0].n_rings_on_blending_layer == 0u);
  BOOST_TEST(std::abs(fine.results.tips[0].statistics.mean.mode_I /
                          (load * std::sqrt(PI * 1e-3) * 1.1496039) -
                      1.) < 1e-5);
  p.degree = p.tip_degree = 1;
  p.enrichment_radius     = 6e-4;
  p.cells_x = p.cells_y = 25;
  const Solved coarse(p);
  BOOST_TEST(coarse.results.tips[0].n_rings_on_blending_layer > 0u);
  BOOST_TEST(coarse.results.tips[0].remark.find("fade out") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_plate_without_cracks)
{
  FE::PlateParameters p = edge_crack();
  p.paths               = "";
  p.support[2]          = "roller";
  check(p);
  const Solved solved(p);
  BOOST_TEST(solved.results.tips.empty());
  // Uniaxial tension: U = sigma^2/(2 E') per area.
  BOOST_TEST(solved.results.strain_energy ==
                 0.5 * load * load / 1e7 * (1. - 0.09) * 1e-4,
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(grids_for_paraview)
{
  VtuGrid grid;
  grid.add_point(1., 2.);
  grid.add_point(3., 4.);
  grid.add_cell(VtuGrid::Shape::poly_line, 2);
  grid.point_field("height", 1) = {5., 6.};
  const std::string text        = grid.text();
  BOOST_TEST(text.find("NumberOfPoints=\"2\" NumberOfCells=\"1\"") !=
             std::string::npos);
  BOOST_TEST(text.find("Name=\"height\" NumberOfComponents=\"1\"") !=
             std::string::npos);
  BOOST_TEST(
      pvd_text({"a_0.vtu", "a_1.vtu"}).find("part=\"1\" file=\"a_1.vtu\"") !=
      std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
