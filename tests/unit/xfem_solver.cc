// The iterative solver of the enriched system, and several ranks against one.
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/fe/phantom_nodes.h>
#include <morsel/fe/plate_problem.h>

#include <deal.II/distributed/tria.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

namespace
{
  using namespace Morsel::FE;
  using dealii::Point;
  using dealii::Triangulation;

  /// An edge crack in a plate clamped at the bottom, pulled at the top.
  PlateParameters
  plate(const unsigned int cells,
        const unsigned int degree,
        const double       length = 1e-3)
  {
    PlateParameters p;
    p.upper_corner       = Point<2>(1e-2, 1e-2);
    p.cells_x            = cells;
    p.cells_y            = cells;
    p.degree             = degree;
    p.tip_degree         = degree;
    p.enrichment_radius  = 6e-4;
    p.corner_refinements = 0;
    p.paths              = "0, 0.005 > " + std::to_string(length) + ", 0.005";
    p.traction[3]        = "0, 1000";
    p.support[2]         = "clamp";
    return p;
  }


  PlateResults
  solve(PlateParameters p, const std::string &solver)
  {
    p.solver = solver;
    Triangulation<2> triangulation(
        Triangulation<2>::limit_level_difference_at_vertices);
    PlateProblem problem(p, make_cracks(p), triangulation);
    return problem.run();
  }


  PlateResults
  solve_on_all_ranks(PlateParameters p, const std::string &solver)
  {
    p.solver = solver;
    dealii::parallel::distributed::Triangulation<2> triangulation(
        MPI_COMM_WORLD);
    PlateProblem problem(p, make_cracks(p), triangulation);
    return problem.run();
  }


  void
  check_equal(const PlateResults &a,
              const PlateResults &b,
              const double        tolerance)
  {
    BOOST_TEST(a.solve.n_dofs == b.solve.n_dofs);
    BOOST_TEST(a.n_cells == b.n_cells);
    BOOST_TEST(a.strain_energy == b.strain_energy,
               boost::test_tools::tolerance(tolerance));
    BOOST_REQUIRE(a.tips.size() == b.tips.size());
    for (unsigned int t = 0; t < a.tips.size(); ++t)
      {
        const auto k = a.tips[t].statistics.mean, l = b.tips[t].statistics.mean;
        BOOST_TEST(std::abs(k.mode_I - l.mode_I) <
                   tolerance * std::abs(l.mode_I));
        BOOST_TEST(std::abs(k.mode_II - l.mode_II) <
                   tolerance * std::abs(l.mode_I));
      }
  }


  /// Two cracks whose tips attract each other, refined where it matters.
  PlateParameters
  two_cracks()
  {
    PlateParameters p = plate(15, 2);
    p.paths           = "0, 0.0047 > 0.0031, 0.0047; "
                        "0.01, 0.0055 > 0.0062, 0.0052";
    p.tip_refinements = 1;
    p.adaptive_steps  = 3;
    return p;
  }


  /// A crack that opens at a side which is pulled and shifted, so that the
  /// displacements there jump where the side is cut, on hanging nodes.
  PlateParameters
  pulled_plate()
  {
    PlateParameters p = plate(15, 2);
    p.paths           = "0.0047, 0.01 > 0.0052, 0.0061; 0, 0.0047 > "
                        "0.0031, 0.0047";
    p.tip_refinements = 1;
    p.adaptive_steps  = 2;
    p.traction[3]     = "0, 0";
    p.support[3]      = "displacement";
    p.displacement[3] = "1e-8, 3e-8";
    return p;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(xfem_solver)

BOOST_AUTO_TEST_CASE(iterations_stay_bounded)
{
  // Jacobi-CG needs thousands, and more on every finer mesh.
  for (const unsigned int degree : {1, 2})
    for (const unsigned int cells : {13, 25, 51})
      {
        const auto results = solve(plate(cells, degree), "iterative");
        BOOST_TEST_CONTEXT(cells << " cells, degree " << degree)
        {
          BOOST_TEST(results.solve.n_iterations > 0u);
          BOOST_TEST(results.solve.n_iterations < 40u);
          BOOST_TEST(results.solve.condition_number > 1.);
          BOOST_TEST(results.solve.condition_number < 10.);
        }
      }
}

BOOST_AUTO_TEST_CASE(iterative_and_direct_agree)
{
  // A long crack; one 1e-8 cells beside the mesh lines; hanging nodes; degree
  // 4 with tip functions of another degree.
  std::vector<PlateParameters> cases = {plate(25, 2, 4e-3),
                                        plate(50, 1),
                                        plate(13, 2),
                                        plate(13, 4),
                                        two_cracks()};
  cases[1].line_shift                = {{1e-8, 1e-8}};
  cases[2].adaptive_steps            = 4;
  cases[3].tip_degree                = 3;
  cases[3].corner_refinements        = 6;
  for (unsigned int i = 0; i < cases.size(); ++i)
    BOOST_TEST_CONTEXT("case " << i)
    {
      const auto direct    = solve(cases[i], "multifrontal");
      const auto iterative = solve(cases[i], "iterative");
      check_equal(iterative, direct, 1e-9);
      BOOST_TEST(iterative.solve.n_iterations < 60u);
    }
}

BOOST_AUTO_TEST_CASE(ties_of_duplicates_do_not_run_in_a_circle)
{
  // This mesh has three dofs for one function at one vertex.
  PlateParameters p  = plate(13, 2);
  p.adaptive_steps   = 6;
  const auto results = solve(p, "multifrontal");
  BOOST_TEST(results.strain_energy > 4.61e-6);
  BOOST_TEST(results.strain_energy < 4.6151e-6);
}

BOOST_AUTO_TEST_SUITE_END()


BOOST_AUTO_TEST_SUITE(xfem_ranks)

BOOST_AUTO_TEST_CASE(ranks_agree_with_one)
{
  // Each rank solves the whole problem by itself, too.
  PlateParameters symmetric = plate(14, 2);
  symmetric.support[2]      = "free";
  symmetric.traction[2]     = "0, -1000";
  symmetric.adaptive_steps  = 4;
  for (const auto &p : {two_cracks(), symmetric, pulled_plate()})
    {
      const auto alone = solve(p, "multifrontal");
      for (const std::string solver : {"multifrontal", "iterative"})
        BOOST_TEST_CONTEXT(solver)
      check_equal(solve_on_all_ranks(p, solver), alone, 1e-8);
    }
}

BOOST_AUTO_TEST_CASE(a_failure_on_one_rank_is_one_on_all)
{
  const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int last =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  const int status = Morsel::exit_status_of([&] {
    Morsel::run_on_all_ranks(MPI_COMM_WORLD, [&] {
      if (rank == last)
        throw Morsel::InputError("The last rank's mistake.");
    });
  });
  BOOST_TEST(status == static_cast<int>(Morsel::ExitStatus::bad_input));
}

BOOST_AUTO_TEST_SUITE_END()
