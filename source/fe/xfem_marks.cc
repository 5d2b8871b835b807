// Which vertices and cells the cracks enrich: the geometric half of the
// XFEM space.
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/xfem_space.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// A crack touches a cell when it comes closer than this share of the
    /// cell's diameter.
    constexpr double touching = 1e-6;

    /// Pieces below this share of a cell's area do not count as cut off.
    constexpr double sliver = 1e-7;


    /// Cheap test before the exact one: whether the crack's bounding box
    /// comes near the cell's circumscribed circle.
    bool
    far_away(const Fracture::Crack &crack,
             const Point<2>        &center,
             const double           reach)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          double low = std::numeric_limits<double>::max(), high = -low;
          for (const Point<2> &v : crack.get_vertices())
            {
              low  = std::min(low, v[d]);
              high = std::max(high, v[d]);
            }
          if (center[d] + reach < low || center[d] - reach > high)
            return true;
        }
      return false;
    }


    bool
    touches(const Fracture::Crack &crack, const QuadMap &map)
    {
      const double   size   = map.diameter();
      const Point<2> center = map.to_physical(Point<2>(0.5, 0.5));
      return !far_away(crack, center, (1. + touching) * size) &&
             distance_to_polygon(crack, map.polygon()) <= touching * size;
    }


    bool
    touches(const Fracture::CrackTip &tip, const QuadMap &map)
    {
      const double size = map.diameter();
      return tip.position.distance(map.to_physical(Point<2>(0.5, 0.5))) <
                 2. * size &&
             distance_to_polygon(tip.position, map.polygon()) <=
                 touching * size;
    }


    /// Marks the hanging vertices that depend on a marked one, down to the
    /// finest cells. Without them a function of a marked vertex would end
    /// inside its own support and would have to vanish altogether. This comes
    /// after all steps to coarser cells and is not followed by any, or the
    /// marks would run along the interface.
    void
    spread_to_children(XFEMSpace::VertexField          &marks,
                       const AffineConstraints<double> &hanging,
                       const MPI_Comm                   communicator)
    {
      const auto &partitioner = *marks.get_partitioner();
      for (bool changed = true; changed;)
        {
          XFEMSpace::VertexField additions(marks);
          additions         = 0.;
          unsigned int news = 0;
          for (const auto &line : hanging.get_lines())
            if ((partitioner.in_local_range(line.index) ||
                 partitioner.is_ghost_entry(line.index)) &&
                marks(line.index) == 0. &&
                std::any_of(
                    line.entries.begin(),
                    line.entries.end(),
                    [&](const auto &entry) { return marks(entry.first) > 0.; }))
              {
                additions(line.index) += 1.;
                ++news;
              }
          additions.compress(VectorOperation::add);
          marks.zero_out_ghost_values();
          marks += additions;
          marks.update_ghost_values();
          changed = Utilities::MPI::max(news, communicator) > 0;
        }
    }
  } // namespace


  bool
  XFEMSpace::holds_tip_of(const unsigned int crack, const QuadMap &map) const
  {
    return std::any_of(
        tips.begin(), tips.end(), [&](const Fracture::CrackTip &tip) {
          return tip.crack == crack && touches(tip, map);
        });
  }


  XFEMSpace::VertexField
  XFEMSpace::make_vertex_field() const
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(vertex_handler, relevant);
    return VertexField(vertex_handler.locally_owned_dofs(),
                       relevant,
                       triangulation->get_communicator());
  }


  void
  XFEMSpace::spread_to_parents(VertexField &marks) const
  {
    // A hanging vertex that carries an enrichment needs its parents, on the
    // coarser cell, to carry it, too; these may hang themselves. Every step
    // leads to a coarser cell, so that the marks cannot run along an
    // interface.
    const auto &partitioner = *marks.get_partitioner();
    for (bool changed = true; changed;)
      {
        VertexField additions(marks);
        additions         = 0.;
        unsigned int news = 0;
        for (const auto &line : vertex_hanging.get_lines())
          if (partitioner.in_local_range(line.index) ||
              partitioner.is_ghost_entry(line.index))
            if (marks(line.index) > 0.)
              for (const auto &entry : line.entries)
                if (marks(entry.first) == 0.)
                  {
                    additions(entry.first) += 1.;
                    ++news;
                  }
        additions.compress(VectorOperation::add);
        marks.zero_out_ghost_values();
        marks += additions;
        marks.update_ghost_values();
        changed =
            Utilities::MPI::max(news, triangulation->get_communicator()) > 0;
      }
  }


  void
  XFEMSpace::mark_vertices()
  {
    vertex_handler.reinit(*triangulation);
    vertex_handler.distribute_dofs(FE_Q<2>(1));
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(vertex_handler, relevant);
    vertex_hanging.reinit(relevant);
    DoFTools::make_hanging_node_constraints(vertex_handler, vertex_hanging);

    jump_marks.assign(cracks.size(), make_vertex_field());
    ramps.assign(tips.size(), make_vertex_field());
    std::vector<types::global_dof_index> dofs(4);
    for (const auto &cell : vertex_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const QuadMap map = make_map(cell);
          cell->get_dof_indices(dofs);
          for (unsigned int c = 0; c < cracks.size(); ++c)
            if (touches(cracks[c], map) && !holds_tip_of(c, map))
              for (const types::global_dof_index dof : dofs)
                jump_marks[c](dof) += 1.;
          for (unsigned int t = 0; t < tips.size(); ++t)
            {
              const bool holds_tip = touches(tips[t], map);
              for (unsigned int v = 0; v < 4; ++v)
                if (holds_tip || cell->vertex(v).distance(tips[t].position) <=
                                     tip_parameters[t].radius)
                  ramps[t](dofs[v]) += 1.;
            }
        }

    const auto finish = [&](VertexField &marks) {
      marks.compress(VectorOperation::add);
      marks.update_ghost_values();
      spread_to_parents(marks);
    };
    for (VertexField &marks : jump_marks)
      {
        finish(marks);
        spread_to_children(
            marks, vertex_hanging, triangulation->get_communicator());
      }
    AffineConstraints<double> interpolation(relevant);
    interpolation.merge(vertex_hanging);
    interpolation.close();
    for (VertexField &ramp : ramps)
      {
        finish(ramp);
        ramp.zero_out_ghost_values();
        for (double &value : ramp)
          value = value > 0. ? 1. : 0.;
        interpolation.distribute(ramp);
        ramp.update_ghost_values();
      }
  }


  void
  XFEMSpace::classify_cells()
  {
    enrichments.assign(triangulation->n_active_cells(), CellEnrichment());
    std::vector<std::vector<int>>        jumps(enrichments.size());
    std::vector<std::vector<int>>        tips_of_cell(enrichments.size());
    std::vector<types::global_dof_index> dofs(4);
    for (const auto &cell : vertex_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const QuadMap      map   = make_map(cell);
        const unsigned int index = cell->active_cell_index();
        cell->get_dof_indices(dofs);
        for (unsigned int c = 0; c < cracks.size(); ++c)
          {
            const bool marked =
                std::any_of(dofs.begin(), dofs.end(), [&](auto d) {
                  return jump_marks[c](d) > 0.;
                });
            if (marked && !holds_tip_of(c, map))
              jumps[index].push_back(c);
          }
        for (unsigned int t = 0; t < tips.size(); ++t)
          if (std::any_of(dofs.begin(), dofs.end(), [&](auto d) {
                return ramps[t](d) > 1e-12;
              }))
            tips_of_cell[index].push_back(t);
      }
    assign_slots(jumps, tips_of_cell);
    run_on_all_ranks(triangulation->get_communicator(),
                     [&] { enrich_cells(jumps, tips_of_cell); });
  }


  void
  XFEMSpace::enrich_cells(const std::vector<std::vector<int>> &jumps,
                          const std::vector<std::vector<int>> &tips_of_cell)
  {
    std::vector<types::global_dof_index> dofs(4);
    for (const auto &cell : vertex_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const unsigned int index = cell->active_cell_index();
        CellEnrichment    &e     = enrichments[index];
        if (jumps[index].empty() && tips_of_cell[index].empty())
          continue;
        const QuadMap map = make_map(cell);
        cell->get_dof_indices(dofs);
        for (const int t : tips_of_cell[index])
          {
            e.tip[tip_slot[t]] = t;
            for (unsigned int v = 0; v < 4; ++v)
              e.ramp[tip_slot[t]][v] = ramps[t](dofs[v]);
            // The tip functions jump along the straight line behind the tip.
            const Fracture::CrackTip &tip = tips[t];
            const Point<2> end = tip.position - tip.segment * tip.direction;
            const Fracture::Crack beyond(
                {end, end - tip.segment * tip.direction}, true, true);
            if (distance_to_polygon(beyond, map.polygon()) == 0.)
              {
                std::ostringstream message;
                message << "The enrichment of the crack tip at ("
                        << tip.position
                        << ") m reaches the other end of the tip's segment, "
                        << tip.segment
                        << " m away: choose a smaller enrichment radius or a "
                           "finer mesh.";
                throw InputError(message.str());
              }
          }

        std::vector<Fracture::Crack> here;
        for (const Fracture::Crack &crack : cracks)
          if (touches(crack, map))
            here.push_back(crack);
        const auto pieces  = cut_into_pieces(map.polygon(), here);
        double     largest = 0.;
        Polygon    main    = map.polygon();
        for (const Polygon &piece : pieces)
          if (polygon_area(piece) > largest)
            {
              largest = polygon_area(piece);
              main    = piece;
            }
        e.cut = largest < (1. - sliver) * map.area();
        Tensor<1, 2> center;
        for (const Point<2> &p : main)
          center += p / static_cast<double>(main.size());
        for (const int c : jumps[index])
          {
            e.jump_crack[jump_slot[c]] = c;
            e.touched[jump_slot[c]]    = touches(cracks[c], map);
            e.side[jump_slot[c]] =
                cracks[c].signed_distance(Point<2>(center)) < 0. ? -1. : 1.;
          }
      }
  }


  std::vector<unsigned int>
  XFEMSpace::raise_degrees(std::vector<unsigned int> degrees) const
  {
    // At a hanging face whose finer side has the lower degree the constraints
    // go through the lowest common element of the collection, which has
    // nothing in a slot that one of the finer cells lacks: they would tie
    // enrichments to zero. Such faces are kept clear of them.
    const auto largest = std::max_element(degrees.begin(), degrees.end());
    const unsigned int highest =
        Utilities::MPI::max(largest == degrees.end() ? 0u : *largest,
                            triangulation->get_communicator());
    const auto enriched = [&](const auto &cell) {
      return enrichments[cell->active_cell_index()].enriched();
    };
    for (const auto &cell : triangulation->active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        bool raise = enriched(cell);
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            continue;
          else if (cell->face(f)->has_children())
            for (unsigned int c = 0; c < cell->face(f)->n_children(); ++c)
              raise = raise || enriched(cell->neighbor_child_on_subface(f, c));
          else
            raise = raise || enriched(cell->neighbor(f));
        if (raise)
          degrees[cell->active_cell_index()] = highest;
      }
    return degrees;
  }


  void
  XFEMSpace::assign_slots(const std::vector<std::vector<int>> &jumps,
                          const std::vector<std::vector<int>> &tips_of_cell)
  {
    const auto colour = [&](const std::vector<std::vector<int>> &members,
                            const unsigned int                   n,
                            const char                          *what) {
      std::vector<unsigned int> conflict(n * n, 0);
      for (const std::vector<int> &list : members)
        for (const int a : list)
          for (const int b : list)
            conflict[a * n + b] = 1;
      if (n > 0)
        Utilities::MPI::max(
            conflict, triangulation->get_communicator(), conflict);
      std::vector<int> slot(n, 0);
      for (unsigned int a = 0; a < n; ++a)
        {
          std::array<bool, CellEnrichment::max_slots> taken{};
          for (unsigned int b = 0; b < a; ++b)
            if (conflict[a * n + b] != 0)
              taken[slot[b]] = true;
          const auto first = std::find(taken.begin(), taken.end(), false);
          if (first == taken.end())
            throw InputError(
                "More than " + std::to_string(CellEnrichment::max_slots) +
                " crack " + what + " share one cell: refine the mesh there.");
          slot[a] = first - taken.begin();
        }
      return slot;
    };
    jump_slot = colour(jumps, cracks.size(), "faces");
    tip_slot  = colour(tips_of_cell, tips.size(), "tips");
  }
} // namespace Morsel::FE
