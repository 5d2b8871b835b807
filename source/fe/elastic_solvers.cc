// How the elastic problem's linear system is solved.
#include <morsel/core/errors.h>
#include <morsel/fe/cell_functions.h>
#include <morsel/fe/elastic_problem.h>

#include <deal.II/base/timer.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>

#include <algorithm>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Replaces constrained dofs by their masters: C^T K C, C^T (f - K g).
    void
    condense(ElementSystem &e, const AffineConstraints<double> &constraints)
    {
      if (std::none_of(e.dofs.begin(), e.dofs.end(), [&](const unsigned int d) {
            return constraints.is_constrained(d);
          }))
        return;
      const unsigned int        n = e.dofs.size();
      std::vector<unsigned int> masters;
      struct Entry
      {
        unsigned int row, column;
        double       value;
      };
      std::vector<Entry> C;
      Eigen::VectorXd    g   = Eigen::VectorXd::Zero(n);
      const auto         add = [&](const unsigned int row,
                           const unsigned int dof,
                           const double       value) {
        const auto place = std::find(masters.begin(), masters.end(), dof);
        C.push_back(
            {row, static_cast<unsigned int>(place - masters.begin()), value});
        if (place == masters.end())
          masters.push_back(dof);
      };
      for (unsigned int i = 0; i < n; ++i)
        if (constraints.is_constrained(e.dofs[i]))
          {
            g(i) = constraints.get_inhomogeneity(e.dofs[i]);
            for (const auto &entry :
                 *constraints.get_constraint_entries(e.dofs[i]))
              add(i, entry.first, entry.second);
          }
        else
          add(i, e.dofs[i], 1.);
      const unsigned int    m  = masters.size();
      const Eigen::VectorXd f  = e.rhs - e.matrix * g;
      Eigen::MatrixXd       KC = Eigen::MatrixXd::Zero(n, m);
      for (const Entry &c : C)
        KC.col(c.column) += c.value * e.matrix.col(c.row);
      e.matrix = Eigen::MatrixXd::Zero(m, m);
      e.rhs    = Eigen::VectorXd::Zero(m);
      for (const Entry &c : C)
        {
          e.matrix.row(c.column) += c.value * KC.row(c.row);
          e.rhs(c.column) += c.value * f(c.row);
        }
      e.dofs = masters;
    }
  } // namespace


  ElasticProblem::Solution
  ElasticProblem::solve_multifrontal(
      const AffineConstraints<double> &constraints)
  {
    const auto &handler = space.get_dof_handler();
    AssertThrow(Utilities::MPI::n_mpi_processes(
                    handler.get_triangulation().get_communicator()) == 1,
                ExcMessage("The multifrontal solver runs on one rank."));
    Timer                                timer;
    std::vector<ElementSystem>           elements;
    std::vector<types::global_dof_index> dofs;
    for_each_element([&](const Cell            &cell,
                         const Eigen::MatrixXd &stiffness,
                         const Eigen::VectorXd &rhs) {
      dofs.resize(rhs.size());
      cell->get_dof_indices(dofs);
      ElementSystem e;
      e.dofs.assign(dofs.begin(), dofs.end());
      e.matrix = stiffness;
      e.rhs    = rhs;
      e.center = cell->center();
      condense(e, constraints);
      if (!e.dofs.empty())
        elements.push_back(std::move(e));
    });
    report.assembly_time = timer.wall_time();
    timer.restart();
    Multifrontal          multifrontal;
    const Eigen::VectorXd x =
        multifrontal.solve(std::move(elements), handler.n_dofs());
    Solution solution = make_solution();
    for (unsigned int i = 0; i < x.size(); ++i)
      solution(i) = x(i);
    constraints.distribute(solution);
    report.solver           = "multifrontal Cholesky";
    report.n_dofs           = handler.n_dofs() - constraints.n_constraints();
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
    report.n_dofs     = handler.n_dofs() - constraints.n_constraints();
    report.solve_time = timer.wall_time();
    return solution;
  }
} // namespace Morsel::FE
namespace Morsel::FE
{
  ElasticProblem::Solution
  ElasticProblem::solve_iterative(const dealii::AffineConstraints<double> &)
  {
    return make_solution();
  }
} // namespace Morsel::FE
