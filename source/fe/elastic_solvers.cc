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

    /// All ranks' elements on rank 0, in an order that does not depend on how
    /// they were distributed.
    std::vector<ElementSystem>
    gather_elements(std::vector<ElementSystem> &&mine,
                    const MPI_Comm               communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return std::move(mine);
      std::vector<double> packed;
      for (const ElementSystem &e : mine)
        {
          packed.push_back(e.dofs.size());
          packed.push_back(e.center[0]);
          packed.push_back(e.center[1]);
          packed.insert(packed.end(), e.dofs.begin(), e.dofs.end());
          packed.insert(
              packed.end(), e.rhs.data(), e.rhs.data() + e.rhs.size());
          packed.insert(
              packed.end(), e.matrix.data(), e.matrix.data() + e.matrix.size());
        }
      mine.clear();
      const auto parts = Utilities::MPI::gather(communicator, packed, 0);
      std::vector<ElementSystem> all;
      for (const std::vector<double> &part : parts)
        for (std::size_t i = 0; i < part.size();)
          {
            const unsigned int n = part[i];
            ElementSystem      e;
            e.center = Point<2>(part[i + 1], part[i + 2]);
            i += 3;
            e.dofs.assign(part.begin() + i, part.begin() + i + n);
            e.rhs = Eigen::Map<const Eigen::VectorXd>(&part[i + n], n);
            e.matrix =
                Eigen::Map<const Eigen::MatrixXd>(&part[i + 2 * n], n, n);
            i += 2 * n + n * n;
            all.push_back(std::move(e));
          }
      return all;
    }
  } // namespace


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


  ElasticProblem::Solution
  ElasticProblem::solve_multifrontal(
      const AffineConstraints<double> &constraints)
  {
    const auto    &handler = space.get_dof_handler();
    const MPI_Comm communicator =
        handler.get_triangulation().get_communicator();
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
    Multifrontal    multifrontal;
    Eigen::VectorXd x;
    elements = gather_elements(std::move(elements), communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      x = multifrontal.solve(std::move(elements), handler.n_dofs());
    else
      x.resize(handler.n_dofs());
    MPI_Bcast(x.data(), x.size(), MPI_DOUBLE, 0, communicator);
    Solution solution = make_solution();
    for (const types::global_dof_index i : handler.locally_owned_dofs())
      solution(i) = x(i);
    constraints.distribute(solution);
    report.solver           = "multifrontal Cholesky";
    report.n_dofs           = n_free_dofs(constraints);
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
    report.n_dofs     = n_free_dofs(constraints);
    report.solve_time = timer.wall_time();
    return solution;
  }
} // namespace Morsel::FE
