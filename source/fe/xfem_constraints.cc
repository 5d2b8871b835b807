// Which functions of the XFEM space depend on others or are left out.
#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/xfem_space.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace Morsel::FE
{
  using namespace dealii;

  bool
  XFEMSpace::has_slot(const DoFHandler<2>::cell_iterator &cell,
                      const unsigned int                  kind,
                      const int                           member) const
  {
    const CellEnrichment &e = enrichments[cell->active_cell_index()];
    return (kind <= CellEnrichment::max_slots
                ? e.jump_crack[kind - 1]
                : e.tip[kind - 1 - CellEnrichment::max_slots]) == member;
  }


  void
  XFEMSpace::make_constraints()
  {
    constraints.reinit(relevant_dofs);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    tied_duplicates = 0;
    if (cracks.empty())
      return;
    tie_duplicates();
    drop_inactive_functions();
    if (Utilities::MPI::n_mpi_processes(triangulation->get_communicator()) > 1)
      constraints.make_consistent_in_parallel(
          dof_handler.locally_owned_dofs(),
          relevant_dofs,
          triangulation->get_communicator());
  }


  XFEMSpace::SupportFields
  XFEMSpace::gather_support(const AffineConstraints<double> &hanging) const
  {
    const VertexField zero(dof_handler.locally_owned_dofs(),
                           relevant_dofs,
                           triangulation->get_communicator());
    SupportFields     fields{zero, zero, zero, zero, zero};
    // What a slave gathers belongs to the support of its masters.
    const auto add = [&](VertexField                  &field,
                         const types::global_dof_index dof,
                         const double                  value) {
      if (!hanging.is_constrained(dof))
        field(dof) += value;
      else
        for (const auto &entry : *hanging.get_constraint_entries(dof))
          field(entry.first) += value;
    };
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const CellEnrichment &e = enrichments[cell->active_cell_index()];
        if (!e.enriched())
          continue;
        const LocalNumbering &n = numberings[cell->active_fe_index()];
        dofs.resize(n.kind.size());
        cell->get_dof_indices(dofs);

        for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
          {
            if (e.jump_crack[s] == CellEnrichment::none)
              continue;
            const auto [area_left, area_right] = areas_beside_crack(cell, s);
            const bool outside                 = !is_core(cell, s);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (n.kind[i] == s + 1)
                {
                  add(fields.left, dofs[i], area_left);
                  add(fields.right, dofs[i], area_right);
                  if (e.touched[s])
                    add(fields.touched, dofs[i], 1.);
                  if (outside)
                    add(fields.outside_core, dofs[i], 1.);
                }
          }

        const FiniteElement<2> &fe = cell->get_fe();
        for (unsigned int k = 1; k <= 2 * CellEnrichment::max_slots; ++k)
          {
            const int member = k <= CellEnrichment::max_slots
                                   ? e.jump_crack[k - 1]
                                   : e.tip[k - 1 - CellEnrichment::max_slots];
            if (member == CellEnrichment::none ||
                (k > CellEnrichment::max_slots && tip_parameters[member].ramp))
              continue;
            for (const unsigned int f : cell->face_indices())
              if (is_outer_face(cell, f, k, member))
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  if (n.kind[i] == k && fe.has_support_on_face(i, f))
                    add(fields.forbidden, dofs[i], 1.);
          }
      }
    for (VertexField *field : {&fields.left,
                               &fields.right,
                               &fields.touched,
                               &fields.outside_core,
                               &fields.forbidden})
      {
        field->compress(VectorOperation::add);
        field->update_ghost_values();
      }
    return fields;
  }


  std::pair<double, double>
  XFEMSpace::areas_beside_crack(const DoFHandler<2>::cell_iterator &cell,
                                const unsigned int                  slot) const
  {
    const CellEnrichment &e   = enrichments[cell->active_cell_index()];
    const QuadMap         map = make_map(cell);
    if (!e.cut)
      return e.side[slot] > 0. ? std::make_pair(map.area(), 0.)
                               : std::make_pair(0., map.area());
    const Fracture::Crack    &crack = cracks[e.jump_crack[slot]];
    std::pair<double, double> areas(0., 0.);
    for (const Polygon &piece : cut_into_pieces(map.polygon(), {crack}))
      {
        Tensor<1, 2> center;
        for (const Point<2> &p : piece)
          center += p / static_cast<double>(piece.size());
        (crack.signed_distance(Point<2>(center)) > 0. ? areas.first
                                                      : areas.second) +=
            polygon_area(piece);
      }
    return areas;
  }


  bool
  XFEMSpace::is_core(const DoFHandler<2>::cell_iterator &cell,
                     const unsigned int                  slot) const
  {
    const CellEnrichment &e      = enrichments[cell->active_cell_index()];
    const unsigned int    degree = numberings[cell->active_fe_index()].degree;
    for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
      if (e.tip[s] != CellEnrichment::none &&
          static_cast<int>(tips[e.tip[s]].crack) == e.jump_crack[slot] &&
          tip_parameters[e.tip[s]].tip_degree >= degree &&
          std::all_of(e.ramp[s].begin(), e.ramp[s].end(), [](const double r) {
            return r > 1. - 1e-12;
          }))
        return true;
    return false;
  }


  bool
  XFEMSpace::is_outer_face(const DoFHandler<2>::cell_iterator &cell,
                           const unsigned int                  face,
                           const unsigned int                  kind,
                           const int                           member) const
  {
    if (cell->at_boundary(face))
      return false;
    if (cell->face(face)->has_children())
      {
        for (unsigned int c = 0; c < cell->face(face)->n_children(); ++c)
          if (!has_slot(cell->neighbor_child_on_subface(face, c), kind, member))
            return true;
        return false;
      }
    return !has_slot(cell->neighbor(face), kind, member);
  }


  void
  XFEMSpace::drop_inactive_functions()
  {
    AffineConstraints<double> hanging(relevant_dofs);
    hanging.merge(constraints);
    hanging.close();
    const SupportFields fields = gather_support(hanging);

    const double tolerance =
        tip_parameters.empty() ? 1e-10 : tip_parameters[0].area_tolerance;
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial() ||
            !enrichments[cell->active_cell_index()].enriched())
          continue;
        const LocalNumbering &n = numberings[cell->active_fe_index()];
        dofs.resize(n.kind.size());
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          {
            const types::global_dof_index d = dofs[i];
            if (n.kind[i] == 0 || constraints.is_constrained(d))
              continue;
            const bool   jump = n.kind[i] <= CellEnrichment::max_slots;
            const double left = fields.left(d), right = fields.right(d);
            if (fields.forbidden(d) > 0. ||
                (jump &&
                 (fields.touched(d) == 0. || fields.outside_core(d) == 0. ||
                  std::min(left, right) <= tolerance * (left + right))))
              constraints.add_line(d);
          }
      }
  }


  void
  XFEMSpace::tie_duplicates()
  {
    // Where three or more members of the collection meet at a vertex, the
    // unification compares all of them with one that "dominates", which may
    // have nothing in a slot that two others share. Their dofs stay apart;
    // tie the free ones together.
    std::map<std::pair<unsigned int, unsigned int>, types::global_dof_index>
                                         first;
    std::vector<types::global_dof_index> dofs;
    const auto representative = [&](types::global_dof_index dof) {
      for (const auto *tie = constraints.get_constraint_entries(dof);
           tie != nullptr && tie->size() == 1 && (*tie)[0].second == 1.;
           tie = constraints.get_constraint_entries(dof))
        dof = (*tie)[0].first;
      return dof;
    };
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial() ||
            !enrichments[cell->active_cell_index()].enriched())
          continue;
        const FiniteElement<2> &fe = cell->get_fe();
        const LocalNumbering   &n  = numberings[cell->active_fe_index()];
        dofs.resize(n.kind.size());
        cell->get_dof_indices(dofs);
        const unsigned int per_vertex = fe.n_dofs_per_vertex();
        for (const unsigned int v : cell->vertex_indices())
          for (unsigned int i = 0; i < per_vertex; ++i)
            {
              const unsigned int local = v * per_vertex + i;
              if (n.kind[local] == 0)
                continue;
              // Slot, tip function and component identify a vertex dof.
              const unsigned int place =
                  n.kind[local] * 8 +
                  fe.system_to_base_index(local).first.second;
              const auto [entry, fresh] =
                  first.insert({{cell->vertex_index(v), place}, dofs[local]});
              if (fresh || entry->second == dofs[local])
                continue;
              // Either may be tied already, perhaps to a third one: tie what
              // they are tied to, or the ties would run in a circle.
              types::global_dof_index slave = representative(dofs[local]);
              types::global_dof_index other = representative(entry->second);
              if (slave == other)
                continue;
              // From the later one to the earlier: ranks that meet them in
              // another order would tie each to the other.
              if (slave < other)
                std::swap(slave, other);
              if (constraints.is_constrained(slave))
                std::swap(slave, other);
              if (constraints.is_constrained(slave))
                continue;
              constraints.add_line(slave);
              constraints.add_entry(slave, other, 1.);
              ++tied_duplicates;
            }
      }
  }
} // namespace Morsel::FE
