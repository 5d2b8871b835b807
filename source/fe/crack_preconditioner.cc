#include <morsel/fe/crack_preconditioner.h>
#include <morsel/fe/sparse_assembly.h>

#include <deal.II/fe/fe_q.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {

    /// ML drops couplings below this share of the diagonal's geometric mean
    /// when it aggregates; 0.05 keeps the condition number of quadratic
    /// elements on long cracks seven times lower than 0.
    constexpr double weak_coupling = 0.05;


    /// Free dofs of this rank at one node; invalid: constrained, or not of this
    /// rank.
    struct Node
    {
      std::array<types::global_dof_index, 2> dofs;
      Point<2>                               position;
    };


    /// The nodes of base functions and minus sides that hold any such dof.
    std::vector<Node>
    collect_nodes(const XFEMSpace                 &space,
                  const AffineConstraints<double> &constraints,
                  const PhantomNodes              &nodes)
    {
      const auto       &handler = space.get_dof_handler();
      const IndexSet   &owned   = handler.locally_owned_dofs();
      std::vector<Node> list;
      std::vector<bool> taken(owned.n_elements(), false);
      std::map<unsigned int, std::vector<Point<2>>> nodes_of_degree;
      std::vector<types::global_dof_index>          dofs;
      const auto take = [&](const types::global_dof_index dof) {
        if (!owned.is_element(dof) || constraints.is_constrained(dof) ||
            taken[owned.index_within_set(dof)])
          return false;
        taken[owned.index_within_set(dof)] = true;
        return true;
      };
      for (const auto &cell : handler.active_cell_iterators())
        {
          if (cell->is_artificial())
            continue;
          const LocalNumbering &n =
              space.get_numbering(cell->active_fe_index());
          const QuadMap map    = make_map(cell);
          auto         &points = nodes_of_degree[n.degree];
          if (points.empty())
            points = FE_Q<2>(n.degree).get_unit_support_points();
          dofs.resize(n.kind.size());
          cell->get_dof_indices(dofs);
          std::map<unsigned int, Node> by_function;
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if ((n.kind[i] == 0 || nodes.is_minus_side(dofs[i])) &&
                take(dofs[i]))
              by_function
                  .try_emplace(
                      n.function[i],
                      Node{{{numbers::invalid_dof_index,
                             numbers::invalid_dof_index}},
                           map.to_physical(points[n.function[i] % n.n_base])})
                  .first->second.dofs[n.component[i]] = dofs[i];
          for (const auto &entry : by_function)
            list.push_back(entry.second);
        }
      return list;
    }
  } // namespace


  PatchSolver::PatchSolver(const std::vector<ElementSystem> &elements,
                           const PhantomNodes::DofField     &marks)
      : communicator(marks.get_mpi_communicator())
  {
    // The numbers of this rank's dofs are one contiguous range.
    std::vector<types::global_dof_index> dofs;
    for (unsigned int i = 0; i < marks.locally_owned_size(); ++i)
      if (marks.local_element(i) > 0.)
        {
          mine.push_back(i);
          dofs.push_back(marks.get_partitioner()->local_to_global(i));
        }
    const auto everyone = Utilities::MPI::gather(communicator, dofs, 0);

    std::vector<ElementSystem> inside;
    for (const ElementSystem &e : elements)
      {
        std::vector<unsigned int> kept;
        for (unsigned int i = 0; i < e.dofs.size(); ++i)
          if (marks(e.dofs[i]) > 0.)
            kept.push_back(i);
        if (kept.empty())
          continue;
        ElementSystem part;
        part.center          = e.center;
        const unsigned int n = kept.size();
        part.matrix.resize(n, n);
        part.rhs.setZero(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            part.dofs.push_back(e.dofs[kept[i]]);
            for (unsigned int j = 0; j < n; ++j)
              part.matrix(i, j) = e.matrix(kept[i], kept[j]);
          }
        inside.push_back(std::move(part));
      }
    inside = gather_elements(std::move(inside), communicator);

    // On rank 0: the patch's own numbering is the ranks' lists one after the
    // other.
    std::map<types::global_dof_index, unsigned int> number;
    for (const auto &list : everyone)
      {
        offsets.push_back(number.size());
        counts.push_back(list.size());
        for (const types::global_dof_index d : list)
          number.emplace(d, number.size());
      }
    for (ElementSystem &e : inside)
      for (unsigned int &d : e.dofs)
        d = number.at(d);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      factorisation.factorise(std::move(inside), number.size());
    size = Utilities::MPI::sum(mine.size(), communicator);
  }


  void
  PatchSolver::add_correction(Vector &z, const Vector &r) const
  {
    if (size == 0)
      return;
    std::vector<double> local(mine.size());
    for (unsigned int i = 0; i < mine.size(); ++i)
      local[i] = r.begin()[mine[i]];
    const bool      root = Utilities::MPI::this_mpi_process(communicator) == 0;
    Eigen::VectorXd all(root ? size : 0);
    MPI_Gatherv(local.data(),
                local.size(),
                MPI_DOUBLE,
                all.data(),
                counts.data(),
                offsets.data(),
                MPI_DOUBLE,
                0,
                communicator);
    if (root)
      all = factorisation.solve(all);
    MPI_Scatterv(all.data(),
                 counts.data(),
                 offsets.data(),
                 MPI_DOUBLE,
                 local.data(),
                 local.size(),
                 MPI_DOUBLE,
                 0,
                 communicator);
    for (unsigned int i = 0; i < mine.size(); ++i)
      z.begin()[mine[i]] += local[i];
  }


  /// Rows of the multigrid matrix: two for each node, x and y.
  struct NodalMultigrid::Slots
  {
    IndexSet               owned;
    std::vector<double>    modes;      ///< rigid motions, by mode and owned row
    PhantomNodes::DofField row_of_dof; ///< row plus 1, with ghost values
  };


  NodalMultigrid::NodalMultigrid(const std::vector<ElementSystem> &elements,
                                 const XFEMSpace                  &space,
                                 const AffineConstraints<double>  &constraints,
                                 const PhantomNodes               &nodes)
  {
    Slots slots = number(space, constraints, nodes);
    assemble(elements, slots);
    build(slots.modes);
    const MPI_Comm communicator =
        space.get_dof_handler().get_triangulation().get_communicator();
    input.reinit(slots.owned, communicator);
    output.reinit(slots.owned, communicator);
  }


  NodalMultigrid::Slots
  NodalMultigrid::number(const XFEMSpace                 &space,
                         const AffineConstraints<double> &constraints,
                         const PhantomNodes              &nodes)
  {
    const IndexSet &owned = space.get_dof_handler().locally_owned_dofs();
    const MPI_Comm  communicator =
        space.get_dof_handler().get_triangulation().get_communicator();
    const std::vector<Node> list = collect_nodes(space, constraints, nodes);
    Slots                   slots;
    const unsigned int      n_rows = 2 * list.size();
    const auto by_rank = Utilities::MPI::all_gather(communicator, n_rows);
    const auto here =
        by_rank.begin() + Utilities::MPI::this_mpi_process(communicator);
    const types::global_dof_index first =
        std::accumulate(by_rank.begin(), here, types::global_dof_index(0));
    const types::global_dof_index total =
        std::accumulate(here, by_rank.end(), first);
    slots.owned = IndexSet(total);
    slots.owned.add_range(first, first + n_rows);
    slots.row_of_dof = nodes.zero_field();
    slots.modes.assign(3 * n_rows, 0.);
    for (unsigned int k = 0; k < list.size(); ++k)
      for (unsigned int c = 0; c < 2; ++c)
        {
          const types::global_dof_index d   = list[k].dofs[c];
          const unsigned int            row = 2 * k + c;
          place_of_row.push_back(d == numbers::invalid_dof_index
                                     ? PhantomNodes::none
                                     : owned.index_within_set(d));
          if (d != numbers::invalid_dof_index)
            slots.row_of_dof(d) = first + row + 1.;
          slots.modes[c * n_rows + row] = 1.;
          slots.modes[2 * n_rows + row] =
              c == 0 ? -list[k].position[1] : list[k].position[0];
        }
    slots.row_of_dof.update_ghost_values();
    return slots;
  }


  void
  NodalMultigrid::assemble(const std::vector<ElementSystem> &elements,
                           const Slots                      &slots)
  {
    const auto rows_of = [&](const ElementSystem &e) {
      std::vector<types::global_dof_index> rows(e.dofs.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i] = slots.row_of_dof(e.dofs[i]) > 0.
                      ? static_cast<types::global_dof_index>(
                            slots.row_of_dof(e.dofs[i]) - 0.5)
                      : numbers::invalid_dof_index;
      return rows;
    };
    assemble_matrix(elements,
                    rows_of,
                    slots.owned,
                    slots.row_of_dof.get_mpi_communicator(),
                    matrix);
  }


  void
  NodalMultigrid::build(std::vector<double> &modes)
  {
    Teuchos::ParameterList settings;
    ML_Epetra::SetDefaults("SA", settings);
    settings.set("aggregation: type", "Uncoupled");
    settings.set("aggregation: threshold", weak_coupling);
    settings.set("PDE equations", 2);
    settings.set("null space: type", "pre-computed");
    settings.set("null space: dimension", 3);
    settings.set("null space: vectors", modes.data());
    settings.set("smoother: type", "symmetric Gauss-Seidel");
    settings.set("smoother: sweeps", 2);
    settings.set("coarse: type", "Amesos-KLU");
    settings.set("coarse: max size", 2000);
    settings.set("initialize random seed", true); // the same in every run
    settings.set("ML output", 0);
    cycle.initialize(matrix, settings);
  }


  void
  NodalMultigrid::add_correction(Vector &z, const Vector &r) const
  {
    for (unsigned int row = 0; row < place_of_row.size(); ++row)
      input.begin()[row] = place_of_row[row] == PhantomNodes::none
                               ? 0.
                               : r.begin()[place_of_row[row]];
    cycle.vmult(output, input);
    for (unsigned int row = 0; row < place_of_row.size(); ++row)
      if (place_of_row[row] != PhantomNodes::none)
        z.begin()[place_of_row[row]] += output.begin()[row];
  }


  CrackPreconditioner::CrackPreconditioner(
      const TrilinosWrappers::SparseMatrix &matrix,
      const PatchSolver                    &patch,
      const NodalMultigrid                 &multigrid)
      : matrix(matrix)
      , patch(patch)
      , multigrid(multigrid)
      , rest(matrix.locally_owned_range_indices(),
             matrix.get_mpi_communicator())
  {}


  void
  CrackPreconditioner::vmult(Vector &z, const Vector &r) const
  {
    z = 0.;
    patch.add_correction(z, r);
    matrix.residual(rest, z, r);
    multigrid.add_correction(z, rest);
    matrix.residual(rest, z, r);
    patch.add_correction(z, rest);
  }
} // namespace Morsel::FE
