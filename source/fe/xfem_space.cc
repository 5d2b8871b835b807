// The finite element half of the XFEM space: collection and dofs.
#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/xfem_space.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>
#include <set>

namespace Morsel::FE
{
  using namespace dealii;

  XFEMSpace::XFEMSpace(const Triangulation<2>                  &triangulation,
                       const std::vector<Fracture::Crack>      &cracks,
                       const std::vector<EnrichmentParameters> &tip_parameters)
      : triangulation(&triangulation)
      , cracks(cracks)
      , tips(Fracture::collect_tips(cracks))
      , tip_parameters(tip_parameters)
      , vertex_handler(triangulation)
      , dof_handler(triangulation)
  {
    AssertDimension(tips.size(), tip_parameters.size());
  }


  void
  XFEMSpace::distribute(const std::vector<unsigned int> &degrees)
  {
    AssertDimension(degrees.size(), triangulation->n_active_cells());
    if (cracks.empty())
      enrichments.assign(triangulation->n_active_cells(), CellEnrichment());
    else
      {
        mark_vertices();
        classify_cells();
      }
    build_collection(raise_degrees(degrees));
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant_dofs);
    make_constraints();
  }


  void
  XFEMSpace::build_collection(const std::vector<unsigned int> &degrees)
  {
    // One member per pair of degree and mask that occurs on any rank.
    constexpr unsigned int n_masks = 1u << (2 * CellEnrichment::max_slots);
    std::set<unsigned int> keys;
    for (const auto &cell : triangulation->active_cell_iterators())
      if (cell->is_locally_owned())
        keys.insert(degrees[cell->active_cell_index()] * n_masks +
                    enrichments[cell->active_cell_index()].mask());
    const auto everyone = Utilities::MPI::all_gather(
        triangulation->get_communicator(),
        std::vector<unsigned int>(keys.begin(), keys.end()));
    for (const auto &list : everyone)
      keys.insert(list.begin(), list.end());

    unsigned int any_mask = 0;
    for (const unsigned int key : keys)
      any_mask |= key % n_masks;
    const unsigned int tip_degree =
        tip_parameters.empty() ? 1 : tip_parameters[0].tip_degree;

    collection = hp::FECollection<2>();
    numberings.clear();
    std::map<unsigned int, unsigned int> fe_index;
    const FE_Nothing<2>                  nothing;
    const FE_Q<2>                        tip_fe(tip_degree);
    bases.emplace(tip_degree, LagrangeBasis(tip_degree));
    for (const unsigned int key : keys)
      {
        const unsigned int degree = key / n_masks, mask = key % n_masks;
        const FE_Q<2>      fe(degree);
        bases.emplace(degree, LagrangeBasis(degree));
        std::vector<const FiniteElement<2> *> parts(1, &fe);
        std::vector<unsigned int>             copies(1, 2);
        for (unsigned int s = 0; s < 2 * CellEnrichment::max_slots; ++s)
          if ((any_mask >> s) & 1u)
            {
              const bool used = (mask >> s) & 1u;
              const bool tip  = s >= CellEnrichment::max_slots;
              parts.push_back(
                  !used ? static_cast<const FiniteElement<2> *>(&nothing)
                  : tip ? &tip_fe
                        : &fe);
              copies.push_back(tip ? 8 : 2);
            }
        fe_index[key] = collection.size();
        collection.push_back(FESystem<2>(parts, copies));
        numberings.push_back(
            make_numbering(collection[fe_index[key]], degree, mask));
      }

    dof_handler.reinit(*triangulation);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int index = cell->active_cell_index();
          cell->set_active_fe_index(
              fe_index[degrees[index] * n_masks + enrichments[index].mask()]);
        }
    dof_handler.distribute_dofs(collection);
  }


  LocalNumbering
  XFEMSpace::make_numbering(const FiniteElement<2> &fe,
                            const unsigned int      degree,
                            const unsigned int      mask) const
  {
    LocalNumbering n;
    n.degree   = degree;
    n.mask     = mask;
    n.n_base   = (degree + 1) * (degree + 1);
    n.n_tip    = 0;
    n.n_scalar = n.n_base;
    // The base elements follow the slots that any cell uses; those without
    // dofs on this cell never show up in the element's own numbering.
    unsigned int              base = 1;
    std::vector<unsigned int> kinds(fe.n_base_elements(), 0),
        starts(fe.n_base_elements(), 0);
    for (unsigned int s = 0;
         s < 2 * CellEnrichment::max_slots && base < fe.n_base_elements();
         ++s)
      {
        const bool tip       = s >= CellEnrichment::max_slots;
        const bool has_place = fe.element_multiplicity(base) == (tip ? 8 : 2);
        const bool used      = (mask >> s) & 1u;
        const bool empty     = fe.base_element(base).n_dofs_per_cell() == 0;
        if (!has_place || used == empty)
          continue;
        if (used)
          {
            const unsigned int m = fe.base_element(base).n_dofs_per_cell();
            kinds[base]          = s + 1;
            starts[base]         = n.n_scalar;
            n.n_scalar += tip ? 4 * m : m;
            if (tip)
              n.n_tip = m;
          }
        ++base;
      }
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      {
        const auto         index = fe.system_to_base_index(i);
        const unsigned int b     = index.first.first;
        const unsigned int copy  = index.first.second;
        n.kind.push_back(kinds[b]);
        n.component.push_back(copy % 2);
        n.function.push_back(starts[b] + (copy / 2) * n.n_tip * (copy > 1) +
                             index.second);
      }
    return n;
  }


  types::global_dof_index
  XFEMSpace::n_free_dofs() const
  {
    types::global_dof_index n = 0;
    for (const types::global_dof_index d : dof_handler.locally_owned_dofs())
      n += constraints.is_constrained(d) ? 0 : 1;
    return Utilities::MPI::sum(n, triangulation->get_communicator());
  }
} // namespace Morsel::FE
