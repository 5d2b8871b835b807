// The elastic problem's linear system solved by conjugate gradients.
#include <morsel/core/errors.h>
#include <morsel/fe/crack_preconditioner.h>
#include <morsel/fe/elastic_problem.h>
#include <morsel/fe/sparse_assembly.h>

#include <deal.II/base/timer.h>

#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <sstream>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Residual over that of zero displacement. Discretisation errors of K stay
    /// above 1e-8; solutions differ by less than that from the direct ones.
    constexpr double relative_tolerance = 1e-12;

    constexpr unsigned int max_iterations = 1000;

    /// Layers of cells about the enriched ones that the patch holds.
    constexpr unsigned int overlap = 1;


    /// Positive on the dofs of enriched elements and of the layers about them.
    PhantomNodes::DofField
    mark_patch(const std::vector<ElementSystem> &elements,
               const PhantomNodes::DofField     &zero)
    {
      PhantomNodes::DofField marks(zero);
      for (unsigned int layer = 0; layer <= overlap; ++layer)
        {
          PhantomNodes::DofField more(zero);
          for (const ElementSystem &e : elements)
            if (layer == 0 ? e.enriched
                           : std::any_of(e.dofs.begin(),
                                         e.dofs.end(),
                                         [&](const unsigned int d) {
                                           return marks(d) > 0.;
                                         }))
              for (const unsigned int d : e.dofs)
                more(d) += 1.;
          more.compress(VectorOperation::add);
          more.update_ghost_values();
          marks = more;
          marks.update_ghost_values();
        }
      return marks;
    }
  } // namespace


  ElasticProblem::Solution
  ElasticProblem::solve_iterative(const AffineConstraints<double> &constraints)
  {
    const auto    &handler = space.get_dof_handler();
    const MPI_Comm communicator =
        handler.get_triangulation().get_communicator();
    using Vector = TrilinosWrappers::MPI::Vector;

    Timer              timer;
    const PhantomNodes nodes(space, constraints);
    auto               elements = collect_elements(constraints);
    for (ElementSystem &e : elements)
      nodes.split(e);
    TrilinosWrappers::SparseMatrix matrix;
    assemble_matrix(
        elements,
        [](const ElementSystem &e) {
          return std::vector<types::global_dof_index>(e.dofs.begin(),
                                                      e.dofs.end());
        },
        handler.locally_owned_dofs(),
        communicator,
        matrix);
    Solution rhs = nodes.zero_field();
    for (const ElementSystem &e : elements)
      for (unsigned int i = 0; i < e.dofs.size(); ++i)
        rhs(e.dofs[i]) += e.rhs(i);
    rhs.compress(VectorOperation::add);
    report.assembly_time = timer.wall_time();
    timer.restart();

    const PatchSolver patch(elements, mark_patch(elements, nodes.zero_field()));
    const NodalMultigrid multigrid(elements, space, constraints, nodes);
    elements.clear();
    const CrackPreconditioner preconditioner(matrix, patch, multigrid);
    Vector                    b(handler.locally_owned_dofs(), communicator);
    Vector                    x(handler.locally_owned_dofs(), communicator);
    std::copy(rhs.begin(), rhs.end(), b.begin());
    SolverControl control(
        max_iterations, relative_tolerance * b.l2_norm(), false, false);
    SolverCG<Vector> solver(control);
    solver.connect_condition_number_slot(
        [&](const double number) { report.condition_number = number; });
    try
      {
        solver.solve(matrix, x, b, preconditioner);
      }
    catch (const SolverControl::NoConvergence &failure)
      {
        std::ostringstream message;
        message << "The conjugate gradients stopped after " << failure.last_step
                << " iterations with a residual of "
                << failure.last_residual / b.l2_norm()
                << " of the load: choose 'XFEM/Solver = multifrontal', and "
                   "check that the body is held.";
        throw NumericalError(message.str());
      }

    Solution sides = nodes.zero_field();
    std::copy(x.begin(), x.end(), sides.begin());
    sides.update_ghost_values();
    nodes.join(sides);
    Solution solution = make_solution();
    std::copy(sides.begin(), sides.end(), solution.begin());
    constraints.distribute(solution);
    report.solver       = "preconditioned conjugate gradients";
    report.n_iterations = control.last_step();
    report.n_patch_dofs = patch.n_dofs();
    report.solve_time   = timer.wall_time();
    return solution;
  }
} // namespace Morsel::FE
