#include <morsel/core/errors.h>
#include <morsel/fe/cell_functions.h>
#include <morsel/fe/stress_intensity.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Quadrature over the part of a cell that the rings reach. The weight of
    /// a ring varies over its width and has kinks of its fourth derivative at
    /// both radii: larger cells are divided. With parts of 0.4 of the width
    /// and six points beyond the degree the rule costs K less than 1e-8 (with
    /// 0.6 and four it cost 3e-6).
    CellQuadrature
    ring_quadrature(const XFEMSpace                    &space,
                    const DoFHandler<2>::cell_iterator &cell,
                    const QuadMap                      &map,
                    const Fracture::CrackTip           &tip,
                    const double                        inside,
                    const double                        reach,
                    const double                        resolution)
    {
      const CellEnrichment &e = space.get_enrichment(cell->active_cell_index());
      const unsigned int    n =
          space.get_numbering(cell->active_fe_index()).degree + 6;
      const unsigned int k =
          std::ceil(map.diameter() / std::sqrt(2.) / resolution);
      CellQuadrature all;
      for (unsigned int j = 0; j < k; ++j)
        for (unsigned int i = 0; i < k; ++i)
          {
            std::array<Point<2>, 4> corners;
            double                  nearest = 1e300, farthest = 0.;
            for (unsigned int v = 0; v < 4; ++v)
              {
                corners[v] = map.to_physical(
                    Point<2>((i + v % 2) / double(k), (j + v / 2) / double(k)));
                farthest =
                    std::max(farthest, corners[v].distance(tip.position));
              }
            const QuadMap part(corners);
            nearest = distance_to_polygon(tip.position, part.polygon());
            if (nearest >= reach || farthest <= inside)
              continue;
            const auto pieces =
                e.cut ? cut_into_pieces(part.polygon(), space.get_cracks())
                      : std::vector<Polygon>(1, part.polygon());
            const CellQuadrature q = pieces.size() == 1
                                         ? gauss_quadrature(part, n)
                                         : cut_quadrature(part, pieces, {}, n);
            all.points.insert(
                all.points.end(), q.points.begin(), q.points.end());
            all.weights.insert(
                all.weights.end(), q.weights.begin(), q.weights.end());
          }
      for (const Point<2> &p : all.points)
        all.reference.push_back(map.to_reference(p));
      return all;
    }
  } // namespace


  double
  distance_to_boundary(const Triangulation<2> &triangulation, const Point<2> &p)
  {
    double distance = std::numeric_limits<double>::max();
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            distance = std::min(
                distance,
                Fracture::distance_to_segment(
                    p, cell->face(f)->vertex(0), cell->face(f)->vertex(1)));
    return Utilities::MPI::min(distance, triangulation.get_communicator());
  }


  TipResult
  choose_rings(const XFEMSpace   &space,
               const unsigned int tip,
               const double       radius)
  {
    const Triangulation<2> &triangulation =
        space.get_dof_handler().get_triangulation();
    const Fracture::CrackTip &t     = space.get_tips()[tip];
    const double              limit = Fracture::largest_ring_radius(
        t, space.get_cracks(), distance_to_boundary(triangulation, t.position));

    double       cell_size = std::numeric_limits<double>::max();
    unsigned int degree    = 1;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() &&
          cell->center().distance(t.position) < cell->diameter())
        {
          cell_size = std::min(cell_size, cell->diameter() / std::sqrt(2.));
          degree    = std::max(
              degree, space.get_numbering(cell->active_fe_index()).degree);
        }
    cell_size =
        Utilities::MPI::min(cell_size, triangulation.get_communicator());
    degree = Utilities::MPI::max(degree, triangulation.get_communicator());

    TipResult result;
    result.tip           = tip;
    const double largest = radius > 0. ? radius : 0.95 * limit;
    if (largest > limit)
      {
        std::ostringstream message;
        message << "The ring of radius " << largest
                << " m for the stress intensity at the crack tip ("
                << t.position << ") m does not fit: "
                << Fracture::ring_obstacle(
                       t,
                       space.get_cracks(),
                       distance_to_boundary(triangulation, t.position),
                       {0., largest})
                << ". Choose a radius below that, or 0 for the largest that "
                   "fits.";
        throw InputError(message.str());
      }
    for (const double share : {0.6, 0.8, 1.})
      result.rings.push_back({0.2 * share * largest, share * largest});
    // Measured on M1: the rings then agree to 1e-3 (degree 1) or 1e-4.
    if (degree * largest < 4. * cell_size)
      {
        std::ostringstream remark;
        remark << "The rings at the tip (" << t.position << ") m are only "
               << largest / cell_size << " cells of degree " << degree
               << " wide: refine towards the tip.";
        result.remark = remark.str();
      }
    return result;
  }


  void
  evaluate_rings(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 TipResult                      &result)
  {
    const XFEMSpace          &space = problem.get_space();
    const Fracture::CrackTip &tip   = space.get_tips()[result.tip];
    std::vector<Fracture::InteractionIntegral> integrals;
    double reach = 0., inside = 1e300, resolution = 1e300;
    for (const Fracture::Ring &ring : result.rings)
      {
        integrals.emplace_back(tip, problem.get_material(), ring);
        reach  = std::max(reach, ring.outer_radius);
        inside = std::min(inside, ring.inner_radius);
        resolution =
            std::min(resolution, 0.4 * (ring.outer_radius - ring.inner_radius));
      }

    CellFunctions                        functions(space);
    std::vector<types::global_dof_index> dofs;
    std::vector<double>                  local;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const double r = cell->center().distance(tip.position);
        const double d = 0.5 * cell->diameter();
        if (r - d > reach || r + d < inside)
          continue;
        const QuadMap        map = make_map(cell);
        const CellQuadrature q =
            ring_quadrature(space, cell, map, tip, inside, reach, resolution);
        if (q.points.empty())
          continue;
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        local.resize(dofs.size());
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          local[i] = solution(dofs[i]);
        const auto samples =
            functions.sample(cell,
                             map,
                             functions.coefficients(cell, local),
                             q.points,
                             q.reference);
        for (unsigned int p = 0; p < q.points.size(); ++p)
          {
            const auto sigma =
                problem.get_material().stress(samples[p].gradient);
            for (auto &integral : integrals)
              integral.add(
                  q.points[p], samples[p].gradient, sigma, q.weights[p]);
          }
      }

    result.by_ring.clear();
    result.energy_release.clear();
    for (unsigned int i = 0; i < integrals.size(); ++i)
      {
        const auto          mine = integrals[i].partial_sums();
        std::vector<double> all(mine.size());
        Utilities::MPI::sum(mine, solution.get_mpi_communicator(), all);
        Fracture::InteractionIntegral total(
            tip, problem.get_material(), result.rings[i]);
        total.add_partial_sums(all[0], all[1], all[2]);
        result.by_ring.push_back(total.stress_intensity());
        result.energy_release.push_back(total.energy_release_rate());
      }
    result.statistics = Fracture::ring_statistics(result.by_ring);
  }
} // namespace Morsel::FE
