#include <morsel/fe/cell_functions.h>
#include <morsel/fe/plate_problem.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    using Cell = DoFHandler<2>::active_cell_iterator;


    /// Stresses of the solution at points on a cell.
    std::vector<SymmetricTensor<2, 2>>
    stresses(const ElasticProblem           &problem,
             const ElasticProblem::Solution &solution,
             const Cell                     &cell,
             const std::vector<Point<2>>    &points)
    {
      const QuadMap         map = make_map(cell);
      std::vector<Point<2>> reference;
      // Points a little inside the cell: a face that lies along a crack has
      // another stress on either side.
      std::vector<Point<2>> inside;
      for (const Point<2> &p : points)
        inside.push_back(p + 1e-8 * (cell->center() - p));
      for (const Point<2> &p : inside)
        reference.push_back(map.to_reference(p));
      std::vector<types::global_dof_index> dofs(
          cell->get_fe().n_dofs_per_cell());
      std::vector<double> local;
      cell->get_dof_indices(dofs);
      for (const types::global_dof_index d : dofs)
        local.push_back(solution(d));
      CellFunctions functions(problem.get_space());
      const auto    samples = functions.sample(
          cell, map, functions.coefficients(cell, local), inside, reference);
      std::vector<SymmetricTensor<2, 2>> result;
      for (const auto &sample : samples)
        result.push_back(problem.get_material().stress(sample.gradient));
      return result;
    }


    Tensor<1, 2>
    normal_of(const Cell &cell, const unsigned int f)
    {
      const Tensor<1, 2> t =
          cell->face(f)->vertex(1) - cell->face(f)->vertex(0);
      const Tensor<1, 2> n = Tensor<1, 2>({t[1], -t[0]}) / t.norm();
      return (cell->face(f)->center() - cell->center()) * n > 0. ? n : -1. * n;
    }
  } // namespace


  Vector<float>
  estimate_errors(const ElasticProblem           &problem,
                  const ElasticProblem::Solution &solution)
  {
    const XFEMSpace &space = problem.get_space();
    Vector<float>    squares(
        space.get_dof_handler().get_triangulation().n_active_cells());
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const unsigned int degree =
            space.get_numbering(cell->active_fe_index()).degree;
        for (const unsigned int f : cell->face_indices())
          {
            const QuadMap        map    = make_map(cell);
            const Tensor<1, 2>   normal = normal_of(cell, f);
            const CellQuadrature q =
                face_quadrature(map, f, space.get_cracks(), 2 * degree + 2);
            const auto   mine = stresses(problem, solution, cell, q.points);
            const double h    = cell->face(f)->measure();
            double       sum  = 0.;
            if (cell->at_boundary(f))
              {
                for (unsigned int p = 0; p < q.points.size(); ++p)
                  sum += q.weights[p] *
                         problem
                             .missed_traction(cell->face(f)->boundary_id(),
                                              q.points[p],
                                              normal,
                                              mine[p])
                             .norm_square();
              }
            else
              for (unsigned int p = 0; p < q.points.size(); ++p)
                {
                  // The neighbour at this point: a child, if it is finer.
                  auto neighbor = cell->neighbor(f);
                  if (neighbor->has_children())
                    {
                      const auto first = cell->neighbor_child_on_subface(f, 0);
                      neighbor         = distance_to_polygon(
                                     q.points[p], make_map(first).polygon()) <=
                                         1e-12 * h
                                             ? first
                                             : cell->neighbor_child_on_subface(f, 1);
                    }
                  const Cell other(&space.get_dof_handler().get_triangulation(),
                                   neighbor->level(),
                                   neighbor->index(),
                                   &space.get_dof_handler());
                  const auto theirs =
                      stresses(problem, solution, other, {q.points[p]});
                  sum += q.weights[p] *
                         ((mine[p] - theirs[0]) * normal).norm_square();
                }
            squares(cell->active_cell_index()) += h * sum;
          }
      }
    for (float &value : squares)
      value = std::sqrt(value);
    return squares;
  }


  void
  mark_largest(Triangulation<2>    &triangulation,
               const Vector<float> &errors,
               const double         share)
  {
    // Errors of one cell differ between ranks by the solver's tolerance and
    // by the rounding to float.
    constexpr float    round_off = 1e-6f;
    std::vector<float> mine, all;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        mine.push_back(errors(cell->active_cell_index()));
    for (const auto &part :
         Utilities::MPI::all_gather(triangulation.get_communicator(), mine))
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(), std::greater<float>());
    std::size_t n = std::clamp<std::size_t>(
        std::llround(share * all.size()), 1, all.size());
    while (n < all.size() && all[n] >= (1.f - round_off) * all[n - 1])
      ++n;
    const float smallest = (1.f - 0.5f * round_off) * all[n - 1];
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() &&
          errors(cell->active_cell_index()) >= smallest)
        cell->set_refine_flag();
  }


  Tensor<1, 2>
  ElasticProblem::missed_traction(const types::boundary_id     id,
                                  const Point<2>              &p,
                                  const Tensor<1, 2>          &normal,
                                  const SymmetricTensor<2, 2> &stress) const
  {
    Tensor<1, 2> missed = stress * normal;
    for (const auto &[loaded, traction] : tractions)
      if (loaded == id)
        missed -= traction(p, normal);
    for (const auto &[side, component] : holds)
      if (side == id)
        missed[component] = 0.;
    return missed;
  }
} // namespace Morsel::FE
