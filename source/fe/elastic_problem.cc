#include <morsel/core/errors.h>
#include <morsel/fe/cell_functions.h>
#include <morsel/fe/elastic_problem.h>

#include <algorithm>
#include <cmath>

namespace Morsel::FE
{
  using namespace dealii;

  ElasticProblem::ElasticProblem(const XFEMSpace              &space,
                                 const Fracture::ElasticPlane &material)
      : space(space)
      , material(material)
  {}


  void
  ElasticProblem::for_each_element(
      const std::function<void(const Cell &,
                               const Eigen::MatrixXd &,
                               const Eigen::VectorXd &)> &sink) const
  {
    // Parallelograms of one shape and degree share their stiffness, which
    // does not depend on the size in the plane.
    struct Shape
    {
      unsigned int    fe_index;
      Tensor<2, 2>    jacobian;
      Eigen::MatrixXd stiffness;
    };
    std::vector<Shape> shapes;
    CellFunctions      functions(space);
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const QuadMap         map = make_map(cell);
        const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
        Eigen::VectorXd       rhs = Eigen::VectorXd::Zero(n.kind.size());
        if (cell->at_boundary())
          add_traction(cell, map, rhs);
        const auto compute = [&]() {
          return element_stiffness(functions,
                                   cell,
                                   map,
                                   n,
                                   functions.quadrature(cell, map, 0),
                                   material,
                                   enrichment_regularisation);
        };
        const CellEnrichment &e =
            space.get_enrichment(cell->active_cell_index());
        if (e.enriched() || e.cut || !map.is_parallelogram())
          {
            sink(cell, compute(), rhs);
            continue;
          }
        Tensor<2, 2> shape = map.jacobian(Point<2>(0.5, 0.5));
        shape /= shape.norm();
        auto known =
            std::find_if(shapes.begin(), shapes.end(), [&](const auto &s) {
              return s.fe_index == cell->active_fe_index() &&
                     (s.jacobian - shape).norm() < 1e-12;
            });
        if (known == shapes.end())
          known = shapes.insert(shapes.end(),
                                {cell->active_fe_index(), shape, compute()});
        sink(cell, known->stiffness, rhs);
      }
  }


  ElasticProblem::Solution
  ElasticProblem::make_solution() const
  {
    const auto &handler = space.get_dof_handler();
    return Solution(handler.locally_owned_dofs(),
                    space.get_relevant_dofs(),
                    handler.get_triangulation().get_communicator());
  }


  ElasticProblem::Solution
  ElasticProblem::solve(const SolverKind kind)
  {
    report                 = SolveReport();
    const auto constraints = make_constraints();
    report.n_dofs          = n_free_dofs(constraints);
    Solution solution =
        kind == SolverKind::multifrontal ? solve_multifrontal(constraints)
        : kind == SolverKind::iterative  ? solve_iterative(constraints)
                                         : solve_umfpack(constraints);
    if (!std::isfinite(solution.l2_norm()))
      throw NumericalError("The displacement is not finite: the body, or a "
                           "part that a crack cuts off, is not held.");
    solution.update_ghost_values();
    return solution;
  }


  double
  ElasticProblem::strain_energy(const Solution &solution) const
  {
    double                               energy = 0.;
    std::vector<types::global_dof_index> dofs;
    for_each_element([&](const Cell            &cell,
                         const Eigen::MatrixXd &stiffness,
                         const Eigen::VectorXd &) {
      dofs.resize(stiffness.rows());
      cell->get_dof_indices(dofs);
      Eigen::VectorXd u(dofs.size());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        u(i) = solution(dofs[i]);
      energy += 0.5 * u.dot(stiffness * u);
    });
    return Utilities::MPI::sum(energy, solution.get_mpi_communicator());
  }


  double
  ElasticProblem::traction_work(const Solution &solution) const
  {
    double                               work = 0.;
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned() || !cell->at_boundary())
          continue;
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        Eigen::VectorXd rhs = Eigen::VectorXd::Zero(dofs.size());
        add_traction(cell, make_map(cell), rhs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          work += rhs(i) * solution(dofs[i]);
      }
    return Utilities::MPI::sum(work, solution.get_mpi_communicator());
  }
} // namespace Morsel::FE
