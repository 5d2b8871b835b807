#include <morsel/fe/phantom_nodes.h>

#include <algorithm>
#include <map>

namespace Morsel::FE
{
  using namespace dealii;

  PhantomNodes::PhantomNodes(const XFEMSpace                 &space,
                             const AffineConstraints<double> &constraints)
  {
    const auto &handler = space.get_dof_handler();
    // Masters of masters may lie beyond the ghost cells.
    IndexSet in_reach(space.get_relevant_dofs());
    for (const auto &line : constraints.get_lines())
      for (const auto &entry : line.entries)
        in_reach.add_index(entry.first);
    jump_of.reinit(handler.locally_owned_dofs(),
                   in_reach,
                   handler.get_triangulation().get_communicator());
    base_of.reinit(jump_of);
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : handler.active_cell_iterators())
      {
        if (cell->is_artificial() ||
            !space.get_enrichment(cell->active_cell_index()).enriched())
          continue;
        const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
        dofs.resize(n.kind.size());
        cell->get_dof_indices(dofs);
        std::map<std::pair<unsigned int, unsigned int>, unsigned int> base;
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (n.kind[i] == 0)
            base[{n.function[i], n.component[i]}] = dofs[i];
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (n.kind[i] >= 1 && n.kind[i] <= CellEnrichment::max_slots &&
              !constraints.is_constrained(dofs[i]))
            {
              const unsigned int b =
                  base.at({n.function[i] % n.n_base, n.component[i]});
              if (!constraints.is_constrained(b))
                jump_of(b) = std::max(jump_of(b), dofs[i] + 1.);
            }
      }
    // Ranks that see other cells of the node may have chosen another jump.
    jump_of.compress(VectorOperation::max);
    jump_of.update_ghost_values();
    for (const types::global_dof_index d : handler.locally_owned_dofs())
      if (at(jump_of, d) != none)
        base_of(at(jump_of, d)) = d + 1.;
    base_of.compress(VectorOperation::max);
    base_of.update_ghost_values();
  }


  void
  PhantomNodes::split(ElementSystem &e) const
  {
    const auto place_of = [&](const unsigned int dof) {
      return static_cast<unsigned int>(
          std::find(e.dofs.begin(), e.dofs.end(), dof) - e.dofs.begin());
    };
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    for (unsigned int i = 0; i < e.dofs.size(); ++i)
      {
        const unsigned int jump = at(jump_of, e.dofs[i]);
        const unsigned int base = at(base_of, e.dofs[i]);
        if (jump == none && base == none)
          continue;
        const unsigned int j = place_of(jump != none ? jump : base);
        if (j == e.dofs.size())
          {
            e.dofs.push_back(jump != none ? jump : base);
            e.matrix.conservativeResizeLike(
                Eigen::MatrixXd::Zero(j + 1, j + 1));
            e.rhs.conservativeResizeLike(Eigen::VectorXd::Zero(j + 1));
          }
        if (jump != none)
          pairs.emplace_back(i, j);
      }
    const auto combine = [](auto &&plus, auto &&minus) {
      const auto sum = (0.5 * (plus + minus)).eval();
      minus          = (0.5 * (plus - minus)).eval();
      plus           = sum;
    };
    for (const auto &[i, j] : pairs)
      {
        combine(e.matrix.col(i), e.matrix.col(j));
        combine(e.matrix.row(i), e.matrix.row(j));
        combine(e.rhs.segment<1>(i), e.rhs.segment<1>(j));
      }
  }


  void
  PhantomNodes::join(DofField &u) const
  {
    DofField joined(u);
    for (const types::global_dof_index d : u.locally_owned_elements())
      {
        const unsigned int jump = at(jump_of, d), base = at(base_of, d);
        if (jump != none)
          joined(d) = 0.5 * (u(d) + u(jump));
        else if (base != none)
          joined(d) = 0.5 * (u(base) - u(d));
      }
    u.zero_out_ghost_values();
    u = joined;
  }
} // namespace Morsel::FE
