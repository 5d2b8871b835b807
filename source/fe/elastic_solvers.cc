// The elastic problem's linear system and its direct solution.
#include <morsel/fe/elastic_problem.h>
#include <morsel/fe/multifrontal.h>

#include <deal.II/base/timer.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>

namespace Morsel::FE
{
  using namespace dealii;

  unsigned int
  ElasticProblem::n_free_dofs(
      const AffineConstraints<double> &constraints) const
  {
    unsigned int n = 0;
    for (const types::global_dof_index d :
         space.get_dof_handler().locally_owned_dofs())
      n += constraints.is_constrained(d) ? 0 : 1;
    return Utilities::MPI::sum(
        n, space.get_dof_handler().get_triangulation().get_communicator());
  }


  std::vector<ElementSystem>
  ElasticProblem::collect_elements(
      const AffineConstraints<double> &constraints) const
  {
    std::vector<ElementSystem>           elements;
    std::vector<types::global_dof_index> dofs;
    for_each_element([&](const Cell            &cell,
                         const Eigen::MatrixXd &stiffness,
                         const Eigen::VectorXd &rhs) {
      dofs.resize(rhs.size());
      cell->get_dof_indices(dofs);
      ElementSystem e;
      e.dofs.assign(dofs.begin(), dofs.end());
      e.matrix   = stiffness;
      e.rhs      = rhs;
      e.center   = cell->center();
      e.enriched = space.get_enrichment(cell->active_cell_index()).enriched();
      condense(e, constraints);
      if (!e.dofs.empty())
        elements.push_back(std::move(e));
    });
    return elements;
  }


  ElasticProblem::Solution
  ElasticProblem::solve_multifrontal(
      const AffineConstraints<double> &constraints)
  {
    const auto    &handler = space.get_dof_handler();
    const MPI_Comm communicator =
        handler.get_triangulation().get_communicator();
    Timer timer;
    auto  elements       = collect_elements(constraints);
    report.assembly_time = timer.wall_time();
    timer.restart();
    Multifrontal    multifrontal;
    Eigen::VectorXd x(handler.n_dofs());
    elements = gather_elements(std::move(elements), communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        x = assemble_rhs(elements, handler.n_dofs());
        multifrontal.factorise(std::move(elements), handler.n_dofs());
        x = multifrontal.solve(x);
      }
    MPI_Bcast(x.data(), x.size(), MPI_DOUBLE, 0, communicator);
    Solution solution = make_solution();
    for (const types::global_dof_index i : handler.locally_owned_dofs())
      solution(i) = x(i);
    constraints.distribute(solution);
    report.solver           = "multifrontal Cholesky";
    report.n_dropped_pivots = multifrontal.n_dropped_pivots();
    report.smallest_pivot   = multifrontal.smallest_relative_pivot();
    report.solve_time       = timer.wall_time();
    return solution;
  }


  ElasticProblem::Solution
  ElasticProblem::solve_umfpack(const AffineConstraints<double> &constraints)
  {
    const auto            &handler = space.get_dof_handler();
    Timer                  timer;
    DynamicSparsityPattern dynamic(handler.n_dofs());
    DoFTools::make_sparsity_pattern(handler, dynamic, constraints, false);
    SparsityPattern sparsity;
    sparsity.copy_from(dynamic);
    SparseMatrix<double> matrix(sparsity);
    Vector<double>       rhs(handler.n_dofs()), x(handler.n_dofs());
    std::vector<types::global_dof_index> dofs;
    for_each_element([&](const Cell            &cell,
                         const Eigen::MatrixXd &stiffness,
                         const Eigen::VectorXd &f) {
      const unsigned int n = f.size();
      dofs.resize(n);
      cell->get_dof_indices(dofs);
      FullMatrix<double> K(n, n, stiffness.data());
      Vector<double>     local(f.data(), f.data() + n);
      constraints.distribute_local_to_global(K, local, dofs, matrix, rhs);
    });
    report.assembly_time = timer.wall_time();
    timer.restart();
    SparseDirectUMFPACK solver;
    solver.initialize(matrix);
    solver.vmult(x, rhs);
    constraints.distribute(x);
    Solution solution = make_solution();
    for (unsigned int i = 0; i < x.size(); ++i)
      solution(i) = x(i);
    report.solver     = "UMFPACK";
    report.solve_time = timer.wall_time();
    return solution;
  }
} // namespace Morsel::FE
