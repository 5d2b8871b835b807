#include <morsel/fe/cell_functions.h>
#include <morsel/fe/point_values.h>
#include <morsel/fe/ring_quadrature.h>
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
    /// What resolves the field about a point: edge length of the smallest cell
    /// there [m], and the highest degree.
    struct Resolution
    {
      double       cell_size = std::numeric_limits<double>::max();
      unsigned int degree    = 1;
    };

    Resolution
    resolution_at(const XFEMSpace &space, const Point<2> &p)
    {
      Resolution local;
      for (const auto &cell : space.get_dof_handler().active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->center().distance(p) < cell->diameter())
          {
            local.cell_size =
                std::min(local.cell_size, cell->diameter() / std::sqrt(2.));
            local.degree =
                std::max(local.degree,
                         space.get_numbering(cell->active_fe_index()).degree);
          }
      const MPI_Comm communicator = space.get_dof_handler().get_communicator();
      return {Utilities::MPI::min(local.cell_size, communicator),
              Utilities::MPI::max(local.degree, communicator)};
    }


    unsigned int
    lowest_degree(const XFEMSpace &space)
    {
      unsigned int degree = std::numeric_limits<unsigned int>::max();
      for (const auto &cell : space.get_dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          degree = std::min(
              degree, space.get_numbering(cell->active_fe_index()).degree);
      return Utilities::MPI::min(degree,
                                 space.get_dof_handler().get_communicator());
    }


    /// Adds this rank's cells to the integrals.
    void
    add_cells(const ElasticProblem                       &problem,
              const ElasticProblem::Solution             &solution,
              const Fracture::CrackTip                   &tip,
              const std::vector<Fracture::Ring>          &rings,
              std::vector<Fracture::InteractionIntegral> &integrals)
    {
      const XFEMSpace                     &space = problem.get_space();
      CellFunctions                        functions(space);
      std::vector<types::global_dof_index> dofs;
      std::vector<double>                  local;
      for_each_ring_cell(
          space,
          tip,
          rings,
          [&](const auto &cell, const QuadMap &map, const CellQuadrature &q) {
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
          });
    }


    /// Adds the faces' part of J_2 to the integrals, whose rings grow in
    /// their order. The energies of the two faces differ like r^(-1/2):
    /// Gauss points in the square root of the distance. They keep a small angle
    /// off the faces, not a small distance: near the tip the energy's odd part
    /// grows like the angle over r.
    void
    add_crack_faces(const ElasticProblem                       &problem,
                    const ElasticProblem::Solution             &solution,
                    const Fracture::CrackTip                   &tip,
                    std::vector<Fracture::InteractionIntegral> &integrals)
    {
      constexpr unsigned int n_intervals = 16;
      const double           reach = integrals.back().get_ring().outer_radius;
      const GaussRule       &rule  = gauss_rule(6);
      std::vector<double>    distances, weights;
      for (unsigned int k = 0; k < n_intervals; ++k)
        for (unsigned int q = 0; q < rule.points.size(); ++q)
          {
            const double t = (k + rule.points[q]) / n_intervals;
            distances.push_back(reach * t * t);
            weights.push_back(2. * reach * t * rule.weights[q] / n_intervals);
          }
      const Tensor<1, 2>    normal({-tip.direction[1], tip.direction[0]});
      std::vector<Point<2>> points;
      for (const double side : {1., -1.})
        for (const double r : distances)
          points.push_back(tip.position - r * tip.direction +
                           side * 1e-6 * r * normal);
      const auto samples = sample_points(problem, solution, points);
      // Every rank has all values: one of them adds.
      if (Utilities::MPI::this_mpi_process(solution.get_mpi_communicator()) > 0)
        return;
      const auto energy = [&](const unsigned int i) {
        const Tensor<2, 2> &H = samples[i].gradient;
        return 0.5 * scalar_product(
                         Tensor<2, 2>(problem.get_material().stress(H)), H);
      };
      for (unsigned int i = 0; i < distances.size(); ++i)
        for (auto &integral : integrals)
          integral.add_faces(distances[i],
                             energy(i) - energy(distances.size() + i),
                             weights[i]);
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


  BlendingLayer
  find_blending_layer(const XFEMSpace &space, const unsigned int tip)
  {
    const DoFHandler<2> &handler  = space.get_dof_handler();
    const Point<2>      &position = space.get_tips()[tip].position;
    double               inner = std::numeric_limits<double>::max(), outer = 0.;
    for (const auto &cell : handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const CellEnrichment &e =
            space.get_enrichment(cell->active_cell_index());
        for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
          if (e.tip[s] == static_cast<int>(tip) &&
              std::any_of(e.ramp[s].begin(),
                          e.ramp[s].end(),
                          [](const double r) { return r < 1. - 1e-12; }))
            {
              inner = std::min(
                  inner,
                  distance_to_polygon(position, make_map(cell).polygon()));
              for (const unsigned int v : cell->vertex_indices())
                outer = std::max(outer, position.distance(cell->vertex(v)));
            }
      }
    const MPI_Comm communicator = handler.get_communicator();
    outer                       = Utilities::MPI::max(outer, communicator);
    inner                       = Utilities::MPI::min(inner, communicator);
    return {outer > 0. ? inner : 0., outer};
  }


  TipResult
  choose_rings(const XFEMSpace   &space,
               const unsigned int tip,
               const double       radius)
  {
    const Triangulation<2> &triangulation =
        space.get_dof_handler().get_triangulation();
    const Fracture::CrackTip &t = space.get_tips()[tip];
    const double to_boundary = distance_to_boundary(triangulation, t.position);
    Fracture::check_ring_radius(t, space.get_cracks(), to_boundary, radius);
    const double limit =
        Fracture::largest_ring_radius(t, space.get_cracks(), to_boundary);
    const auto [cell_size, degree] = resolution_at(space, t.position);
    const BlendingLayer blending   = find_blending_layer(space, tip);

    // Clear of what they must not touch; at degree 1, where the blending
    // layer is felt, inside it if the rings are then still wide enough.
    const bool linear  = lowest_degree(space) == 1;
    double     largest = radius > 0. ? radius : 0.95 * limit;
    if (linear && radius == 0. && blending.inner_radius >= 2. * cell_size)
      largest = std::min(largest, blending.inner_radius);
    TipResult result;
    result.tip = tip;
    for (const double share : {0.6, 0.8, 1.})
      {
        result.rings.push_back({0.2 * share * largest, share * largest});
        const Fracture::Ring &ring = result.rings.back();
        if (ring.inner_radius < blending.outer_radius &&
            ring.outer_radius > blending.inner_radius * (1. + 1e-9))
          ++result.n_rings_on_blending_layer;
      }

    std::ostringstream remark;
    // Measured on M1: wider rings agree to 1e-3 (degree 1) or 1e-4.
    if (degree * largest < 4. * cell_size)
      remark << "The rings at the tip (" << t.position << ") m are only "
             << largest / cell_size << " cells of degree " << degree
             << " wide: refine towards the tip.";
    if (linear && result.n_rings_on_blending_layer > 0)
      remark << (remark.str().empty() ? "" : " ") << "Of the "
             << result.rings.size() << " rings at the tip (" << t.position
             << ") m " << result.n_rings_on_blending_layer
             << " overlap the layer from " << blending.inner_radius << " to "
             << blending.outer_radius
             << " m in which the tip functions fade out, where K depends on "
                "the ring at degree 1: choose a larger enrichment radius, a "
                "finer mesh, or degree 2.";
    result.remark = remark.str();
    return result;
  }


  void
  evaluate_rings(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 TipResult                      &result,
                 const bool                      both_components)
  {
    const XFEMSpace          &space = problem.get_space();
    const Fracture::CrackTip &tip   = space.get_tips()[result.tip];
    std::vector<Fracture::InteractionIntegral> integrals;
    for (const Fracture::Ring &ring : result.rings)
      integrals.emplace_back(tip, problem.get_material(), ring);
    add_cells(problem, solution, tip, result.rings, integrals);
    if (both_components)
      add_crack_faces(problem, solution, tip, integrals);
    const MPI_Comm communicator = solution.get_mpi_communicator();
    result.by_ring.clear();
    result.energy_release.clear();
    result.energy_release_across.clear();
    for (unsigned int i = 0; i < integrals.size(); ++i)
      {
        const auto          mine = integrals[i].partial_sums();
        std::vector<double> all(mine.size());
        Utilities::MPI::sum(mine, communicator, all);
        Fracture::InteractionIntegral total(
            tip, problem.get_material(), result.rings[i]);
        total.add_partial_sums(all);
        result.by_ring.push_back(total.stress_intensity());
        result.energy_release.push_back(total.energy_release_rate());
        if (both_components)
          result.energy_release_across.push_back(
              total.energy_release_rate_across());
      }
    result.statistics = Fracture::ring_statistics(result.by_ring);
  }
} // namespace Morsel::FE
