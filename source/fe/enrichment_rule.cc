#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fe/enrichment_rule.h>
#include <morsel/fe/polygon.h>
#include <morsel/fe/stress_intensity.h>
#include <morsel/fracture/interaction_integral.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Measured on an edge crack, see doc/jaw.md.
    constexpr double layers_of_tip_functions = 6.;

    /// Of the segment at the tip that its functions may take where it ends at a
    /// mouth.
    constexpr double share_of_segment = 0.9;

    /// Cells between tip functions and an inner end of the segment: they
    /// fade out over the diagonal of one, next to which there may be a larger.
    constexpr double cells_to_end = 3.;


    /// Outer radius of the largest ring over the cell at the tip, at least: in
    /// smaller ones there is nothing but the tip functions of one cell.
    constexpr double smallest_rings = 0.02;


    template <typename CellIterator>
    bool
    holds(const CellIterator &cell, const Point<2> &p)
    {
      return p.distance(cell->center()) < cell->diameter() &&
             distance_to_polygon(p, make_map(cell).polygon()) <=
                 1e-6 * cell->diameter();
    }
  } // namespace


  double
  cell_size_at(const Triangulation<2> &mesh, const Point<2> &p)
  {
    double size = std::numeric_limits<double>::max();
    for (const auto &cell : mesh.active_cell_iterators())
      if (holds(cell, p))
        size = std::min(size, cell->diameter() / std::sqrt(2.));
    return size;
  }


  std::vector<EnrichmentParameters>
  enrichment_by_rule(const Triangulation<2>             &mesh,
                     const std::vector<Fracture::Crack> &cracks,
                     const unsigned int                  degree)
  {
    std::vector<EnrichmentParameters> parameters;
    for (const Fracture::CrackTip &tip : Fracture::collect_tips(cracks))
      {
        const double h     = cell_size_at(mesh, tip.position);
        const auto  &crack = cracks[tip.crack];
        const bool   ends_inside =
            crack.get_vertices().size() > 2 || crack.has_tip(1 - tip.end);
        const double room =
            ends_inside
                ? tip.segment -
                      cells_to_end *
                          cell_size_at(
                              mesh, tip.position - tip.segment * tip.direction)
                : share_of_segment * tip.segment;
        EnrichmentParameters p;
        p.tip_degree = degree;
        p.radius     = std::clamp(room, 0., layers_of_tip_functions * h);
        parameters.push_back(p);
      }
    return parameters;
  }


  void
  check_tips_apart(const Triangulation<2>                &mesh,
                   const std::vector<Fracture::CrackTip> &tips,
                   const std::string                     &remedy)
  {
    unsigned int crowded = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        unsigned int n_tips = 0;
        for (unsigned int t = 0; t < tips.size(); ++t)
          if (holds(cell, tips[t].position) && ++n_tips > 1)
            crowded = std::max(crowded, t);
      }
    crowded = Utilities::MPI::max(crowded, mesh.get_communicator());
    if (crowded > 0)
      throw InputError(
          "The crack tip at (" + number_text(tips[crowded].position[0]) + ", " +
          number_text(tips[crowded].position[1]) +
          ") m shares a cell of the mesh with another one: " + remedy + ".");
  }


  void
  check_room_for_rings(const XFEMSpace   &space,
                       const double       ring_radius,
                       const std::string &remedy)
  {
    const Triangulation<2> &mesh = space.get_dof_handler().get_triangulation();
    for (const Fracture::CrackTip &tip : space.get_tips())
      {
        const double room      = ring_radius > 0.
                                     ? ring_radius
                                     : Fracture::largest_ring_radius(
                                      tip,
                                      space.get_cracks(),
                                      distance_to_boundary(mesh, tip.position));
        const double cell_size = Utilities::MPI::min(
            cell_size_at(mesh, tip.position), mesh.get_communicator());
        if (room >= smallest_rings * cell_size)
          continue;
        throw InputError(
            "The crack tip at (" + number_text(tip.position[0]) + ", " +
            number_text(tip.position[1]) +
            ") m has room for rings of the interaction integral of " +
            number_text(room) + " m, " + number_text(room / cell_size) +
            " of its cell, and at least " + number_text(smallest_rings) +
            " of it are needed: keep the tip off the boundary, mouths, kinks "
            "and other cracks, or " +
            remedy + ".");
      }
  }
} // namespace Morsel::FE
