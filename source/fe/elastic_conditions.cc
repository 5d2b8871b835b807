#include <morsel/fe/cell_functions.h>
#include <morsel/fe/elastic_problem.h>
#include <morsel/fe/multifrontal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    Tensor<1, 2>
    outward_normal(const QuadMap &map, const unsigned int face)
    {
      const auto         v = face_vertices[face];
      const Tensor<1, 2> t =
          map.get_vertices()[v[1]] - map.get_vertices()[v[0]];
      return Tensor<1, 2>({t[1], -t[0]}) / t.norm();
    }
  } // namespace


  CellQuadrature
  face_quadrature(const QuadMap                      &map,
                  const unsigned int                  face,
                  const std::vector<Fracture::Crack> &cracks,
                  const unsigned int                  n)
  {
    const auto          v      = face_vertices[face];
    const Point<2>      a      = map.get_vertices()[v[0]];
    const Tensor<1, 2>  t      = map.get_vertices()[v[1]] - a;
    std::vector<double> limits = {0., 1.};
    for (const Fracture::Crack &crack : cracks)
      {
        const auto &c = crack.get_vertices();
        for (unsigned int s = 0; s + 1 < c.size(); ++s)
          {
            const Tensor<1, 2> d           = c[s + 1] - c[s];
            const Tensor<1, 2> g           = c[s] - a;
            const double       determinant = t[1] * d[0] - t[0] * d[1];
            if (std::abs(determinant) < 1e-14 * t.norm() * d.norm())
              continue;
            const double on_face  = (g[1] * d[0] - g[0] * d[1]) / determinant;
            const double on_crack = (g[1] * t[0] - g[0] * t[1]) / determinant;
            if (on_crack > -1e-10 && on_crack < 1. + 1e-10 && on_face > 1e-12 &&
                on_face < 1. - 1e-12)
              limits.push_back(on_face);
          }
      }
    std::sort(limits.begin(), limits.end());
    CellQuadrature   quadrature;
    const GaussRule &rule = gauss_rule(n);
    for (unsigned int k = 0; k + 1 < limits.size(); ++k)
      for (unsigned int q = 0; q < n; ++q)
        {
          const double width = limits[k + 1] - limits[k];
          quadrature.points.push_back(a +
                                      (limits[k] + width * rule.points[q]) * t);
          quadrature.weights.push_back(width * rule.weights[q] * t.norm());
          quadrature.reference.push_back(
              map.to_reference(quadrature.points.back()));
        }
    return quadrature;
  }


  void
  ElasticProblem::apply_traction(const types::boundary_id id,
                                 const Field             &traction)
  {
    tractions.emplace_back(id, traction);
  }


  void
  ElasticProblem::hold(const types::boundary_id id,
                       const unsigned int       component)
  {
    AssertIndexRange(component, 2);
    holds.emplace_back(id, component);
  }


  void
  ElasticProblem::pin(const Point<2> &point, const unsigned int component)
  {
    AssertIndexRange(component, 2);
    pins.emplace_back(point, component);
  }


  namespace
  {
    /// One face's part of the normal equations of the L2 projection of a
    /// displacement on the traces that are free and belong to the wanted
    /// components.
    ElementSystem
    trace_projection(const XFEMSpace                           &space,
                     const DoFHandler<2>::active_cell_iterator &cell,
                     const unsigned int                         face,
                     const AffineConstraints<double>           &constraints,
                     const ElasticProblem::Field               &displacement,
                     const std::array<bool, 2>                 &components)
    {
      const QuadMap         map = make_map(cell);
      const LocalNumbering &n   = space.get_numbering(cell->active_fe_index());
      const CellQuadrature  q =
          face_quadrature(map, face, space.get_cracks(), n.degree + 6);
      CellFunctions functions(space);
      functions.evaluate(cell, map, q.points, q.reference);
      const Tensor<1, 2>                   normal = outward_normal(map, face);
      std::vector<types::global_dof_index> dofs(n.kind.size());
      cell->get_dof_indices(dofs);
      std::vector<unsigned int> on_face;
      ElementSystem             e;
      e.center = cell->face(face)->center();
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (components[n.component[i]] &&
            cell->get_fe().has_support_on_face(i, face) &&
            !constraints.is_constrained(dofs[i]))
          {
            on_face.push_back(i);
            e.dofs.push_back(dofs[i]);
          }
      const unsigned int m = on_face.size();
      e.matrix             = Eigen::MatrixXd::Zero(m, m);
      e.rhs                = Eigen::VectorXd::Zero(m);
      for (unsigned int p = 0; p < q.points.size(); ++p)
        {
          const Tensor<1, 2> u = displacement(q.points[p], normal);
          for (unsigned int i = 0; i < m; ++i)
            {
              const unsigned int c = n.component[on_face[i]];
              const double       vi =
                  q.weights[p] * functions.values()(p, n.function[on_face[i]]);
              e.rhs(i) += vi * u[c];
              for (unsigned int j = 0; j < m; ++j)
                if (n.component[on_face[j]] == c)
                  e.matrix(i, j) +=
                      vi * functions.values()(p, n.function[on_face[j]]);
            }
        }
      // Traces of enrichments may be dependent but for round-off: those get
      // the value zero.
      e.matrix.diagonal() *= 1. + enrichment_regularisation;
      return e;
    }
  } // namespace


  void
  ElasticProblem::prescribe(const std::set<types::boundary_id> &ids,
                            const Field                        &displacement,
                            const std::array<bool, 2>          &components)
  {
    std::vector<ElementSystem> elements;
    AffineConstraints<double>  constraints(space.get_relevant_dofs());
    constraints.merge(space.get_constraints());
    constraints.close();
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) &&
              ids.count(cell->face(f)->boundary_id()) > 0)
            {
              ElementSystem e = trace_projection(
                  space, cell, f, constraints, displacement, components);
              if (!e.dofs.empty())
                elements.push_back(std::move(e));
            }

    // The traces are few: one rank solves for all.
    const auto    &handler = space.get_dof_handler();
    const MPI_Comm communicator =
        handler.get_triangulation().get_communicator();
    elements = gather_elements(std::move(elements), communicator);
    std::vector<std::pair<types::global_dof_index, double>> values;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::set<types::global_dof_index> touched;
        for (const ElementSystem &e : elements)
          touched.insert(e.dofs.begin(), e.dofs.end());
        const Eigen::VectorXd rhs = assemble_rhs(elements, handler.n_dofs());
        Multifrontal          projection;
        projection.factorise(std::move(elements), handler.n_dofs());
        const Eigen::VectorXd x = projection.solve(rhs);
        for (const types::global_dof_index d : touched)
          values.emplace_back(d, x(d));
      }
    values = Utilities::MPI::broadcast(communicator, values, 0);
    for (const auto &[dof, value] : values)
      if (space.get_relevant_dofs().is_element(dof))
        prescribed[dof] = value;
  }


  AffineConstraints<double>
  ElasticProblem::make_constraints() const
  {
    AffineConstraints<double> constraints(space.get_relevant_dofs());
    constraints.merge(space.get_constraints());
    // A side that is moved is held, too: its own values come first.
    for (const auto &[dof, value] : prescribed)
      if (!constraints.is_constrained(dof))
        {
          constraints.add_line(dof);
          constraints.set_inhomogeneity(dof, value);
        }
    std::vector<types::global_dof_index> dofs;
    std::vector<double>                  nearest(pins.size(),
                                std::numeric_limits<double>::max());
    std::vector<types::global_dof_index> pinned(pins.size(),
                                                numbers::invalid_dof_index);
    const auto                          &handler = space.get_dof_handler();
    for (const auto &cell : handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
        dofs.resize(n.kind.size());
        cell->get_dof_indices(dofs);
        for (const auto &[id, component] : holds)
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f) && cell->face(f)->boundary_id() == id)
              for (unsigned int i = 0; i < dofs.size(); ++i)
                if (n.component[i] == component &&
                    cell->get_fe().has_support_on_face(i, f) &&
                    !constraints.is_constrained(dofs[i]))
                  constraints.add_line(dofs[i]);
        for (unsigned int p = 0; p < pins.size(); ++p)
          for (const unsigned int v : cell->vertex_indices())
            if (cell->vertex(v).distance(pins[p].first) <
                nearest[p] - 1e-12 * cell->diameter())
              {
                nearest[p] = cell->vertex(v).distance(pins[p].first);
                pinned[p]  = cell->vertex_dof_index(
                    v, pins[p].second, cell->active_fe_index());
              }
      }
    for (unsigned int p = 0; p < pins.size(); ++p)
      {
        const double best = Utilities::MPI::min(
            nearest[p], handler.get_triangulation().get_communicator());
        if (nearest[p] <= best && !constraints.is_constrained(pinned[p]))
          constraints.add_line(pinned[p]);
      }
    if (Utilities::MPI::n_mpi_processes(
            handler.get_triangulation().get_communicator()) > 1)
      constraints.make_consistent_in_parallel(
          handler.locally_owned_dofs(),
          space.get_relevant_dofs(),
          handler.get_triangulation().get_communicator());
    constraints.close();
    return constraints;
  }


  void
  ElasticProblem::add_traction(const Cell      &cell,
                               const QuadMap   &map,
                               Eigen::VectorXd &rhs) const
  {
    const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
    for (const auto &[id, traction] : tractions)
      for (const unsigned int f : cell->face_indices())
        {
          if (!cell->at_boundary(f) || cell->face(f)->boundary_id() != id)
            continue;
          const CellQuadrature q =
              face_quadrature(map, f, space.get_cracks(), n.degree + 4);
          CellFunctions functions(space);
          functions.evaluate(cell, map, q.points, q.reference);
          const Tensor<1, 2> normal = outward_normal(map, f);
          for (unsigned int p = 0; p < q.points.size(); ++p)
            {
              const Tensor<1, 2> t = traction(q.points[p], normal);
              for (unsigned int i = 0; i < n.function.size(); ++i)
                rhs(i) += q.weights[p] * t[n.component[i]] *
                          functions.values()(p, n.function[i]);
            }
        }
  }
} // namespace Morsel::FE
