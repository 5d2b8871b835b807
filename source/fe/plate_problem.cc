#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/enrichment_rule.h>
#include <morsel/fe/plate_mesh.h>
#include <morsel/fe/plate_problem.h>
#include <morsel/fracture/energy_release.h>

#include <deal.II/base/timer.h>

#include <algorithm>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Whether a support prescribes both components of the displacement.
    bool
    holds_both(const std::string &support)
    {
      return support == "clamp" || support == "displacement";
    }
  } // namespace


  PlateProblem::PlateProblem(const PlateParameters              &parameters,
                             const std::vector<Fracture::Crack> &cracks,
                             Triangulation<2>                   &triangulation)
      : parameters(parameters)
      , material(parameters.youngs_modulus,
                 parameters.poissons_ratio,
                 parameters.plane_stress)
      , triangulation(triangulation)
  {
    Timer timer;
    make_mesh();
    const auto tips = Fracture::collect_tips(cracks);
    for (const Fracture::CrackTip &tip : tips)
      refine_towards(triangulation,
                     tip.position,
                     parameters.tip_refinements,
                     parameters.layers);
    EnrichmentParameters enrichment;
    enrichment.tip_degree = parameters.tip_degree;
    enrichment.radius     = parameters.enrichment_radius;
    enrichment.ramp       = parameters.ramp;
    space                 = std::make_unique<XFEMSpace>(
        triangulation,
        cracks,
        std::vector<EnrichmentParameters>(tips.size(), enrichment));
    results.mesh_time = timer.wall_time();
  }


  void
  PlateProblem::make_mesh()
  {
    const Point<2> &low  = parameters.lower_corner;
    const Point<2> &high = parameters.upper_corner;
    make_plate(
        triangulation,
        low,
        high,
        parameters.cells_x,
        parameters.cells_y,
        Tensor<1, 2>({parameters.line_shift[0], parameters.line_shift[1]}));
    // A corner between a clamped side and one that is not is singular.
    for (unsigned int x = 0; x < 2; ++x)
      for (unsigned int y = 0; y < 2; ++y)
        if (holds_both(parameters.support[x]) !=
            holds_both(parameters.support[2 + y]))
          refine_towards(
              triangulation,
              Point<2>(x == 0 ? low[0] : high[0], y == 0 ? low[1] : high[1]),
              parameters.corner_refinements,
              parameters.layers);
  }


  void
  PlateProblem::apply_boundary_conditions()
  {
    bool held[2]  = {false, false};
    bool no_turns = false;
    for (unsigned int side = 0; side < 4; ++side)
      {
        const unsigned int normal = side < 2 ? 0 : 1;
        if (parameters.support[side] != "free")
          {
            problem->hold(side, normal);
            held[normal] = no_turns = true;
          }
        if (holds_both(parameters.support[side]))
          {
            problem->hold(side, 1 - normal);
            held[1 - normal] = true;
          }
        const Tensor<1, 2> displacement =
            Fracture::displacement_of(parameters, side);
        const bool both = holds_both(parameters.support[side]);
        if (displacement.norm() > 0.)
          problem->prescribe(
              {side},
              [displacement](const Point<2> &, const Tensor<1, 2> &) {
                return displacement;
              },
              {{both || normal == 0, both || normal == 1}});
        const Tensor<1, 2> traction = Fracture::traction_on(parameters, side);
        if (traction.norm() > 0.)
          problem->apply_traction(
              side, [traction](const Point<2> &, const Tensor<1, 2> &) {
                return traction;
              });
      }
    const Point<2> &low  = parameters.lower_corner;
    const Point<2> &high = parameters.upper_corner;
    for (unsigned int d = 0; d < 2; ++d)
      if (!held[d])
        problem->pin(Point<2>(high[0], low[1]), d);
    if (!no_turns)
      problem->pin(high, 0);
  }


  std::vector<unsigned int>
  PlateProblem::cell_degrees() const
  {
    std::vector<unsigned int> degrees(triangulation.n_active_cells(),
                                      parameters.degree);
    const unsigned int        smallest =
        std::min(parameters.smallest_degree, parameters.degree);
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        const unsigned int drop = parameters.degree_drop * cell->level();
        degrees[cell->active_cell_index()] = std::max(
            smallest, parameters.degree - std::min(parameters.degree, drop));
      }
    return degrees;
  }


  void
  PlateProblem::set_up()
  {
    const std::string finer =
        "raise 'XFEM/Tip refinements', or the cells along x and y";
    check_tips_apart(triangulation, space->get_tips(), finer);
    check_room_for_rings(*space, parameters.ring_radius, finer);
    space->distribute(cell_degrees());
    problem = std::make_unique<ElasticProblem>(*space, material);
    apply_boundary_conditions();
  }


  void
  PlateProblem::solve_once()
  {
    Timer timer;
    set_up();
    results.space_time += timer.wall_time();
    solution = problem->solve(
        parameters.solver == "umfpack"     ? SolverKind::umfpack
        : parameters.solver == "iterative" ? SolverKind::iterative
                                           : SolverKind::multifrontal);
    // Times are those of all adaptive steps, the rest is of the last one.
    const SolveReport before = results.solve;
    results.solve            = problem->get_report();
    results.solve.assembly_time += before.assembly_time;
    results.solve.solve_time += before.solve_time;
  }


  const PlateResults &
  PlateProblem::solve()
  {
    solve_once();
    for (unsigned int step = 0; step < parameters.adaptive_steps; ++step)
      {
        Timer               timer;
        const Vector<float> errors = estimate_errors(*problem, solution);
        results.estimates.push_back(std::sqrt(Utilities::MPI::sum(
            errors.norm_sqr(), triangulation.get_communicator())));
        mark_largest(triangulation, errors, parameters.refined_share);
        triangulation.execute_coarsening_and_refinement();
        results.mesh_time += timer.wall_time();
        solve_once();
      }
    results.n_cells = triangulation.n_global_active_cells();
    // Clapeyron: the loads, at their full size, do twice the strain energy.
    bool by_tractions = true;
    for (unsigned int side = 0; side < 4; ++side)
      by_tractions = by_tractions &&
                     Fracture::displacement_of(parameters, side).norm() == 0.;
    results.strain_energy = by_tractions
                                ? 0.5 * problem->traction_work(solution)
                                : problem->strain_energy(solution);
    results.external_work = 2. * results.strain_energy;
    return results;
  }


  const PlateResults &
  PlateProblem::run()
  {
    solve();
    Timer timer;
    results.tips.clear();
    for (unsigned int t = 0; t < space->get_tips().size(); ++t)
      {
        results.tips.push_back(choose_rings(*space, t, parameters.ring_radius));
        evaluate_rings(
            *problem, solution, results.tips.back(), parameters.two_directions);
      }
    results.tip_time = timer.wall_time();
    return results;
  }


  void
  check(const PlateParameters &plate)
  {
    Fracture::check(plate);
    const Tensor<1, 2> size    = plate.upper_corner - plate.lower_corner;
    const double       smaller = std::min(size[0], size[1]);
    if (plate.enrichment_radius >= 0.5 * smaller)
      throw InputError("'XFEM/Enrichment radius' is " +
                       number_text(plate.enrichment_radius) +
                       " m; it must be below half the plate's smaller side, " +
                       number_text(0.5 * smaller) + " m.");
    for (const Fracture::CrackTip &tip :
         Fracture::collect_tips(make_cracks(plate)))
      if (plate.enrichment_radius >= tip.segment)
        throw InputError(
            "'XFEM/Enrichment radius' is " +
            number_text(plate.enrichment_radius) +
            " m; it must be below the length of the crack's segment at the "
            "tip (" +
            number_text(tip.position[0]) + ", " + number_text(tip.position[1]) +
            ") m, " + number_text(tip.segment) + " m.");
  }


  double
  energy_route(const PlateParameters &parameters, const double energy)
  {
    const double          da = parameters.energy_growth;
    std::array<double, 3> energies{{energy, 0., 0.}};
    // All three on the same mesh: that of an adaptive loop follows the tips.
    for (unsigned int i = parameters.adaptive_steps > 0 ? 0 : 1; i < 3; ++i)
      {
        PlateParameters grown = parameters;
        grown.adaptive_steps  = 0;
        grown.ring_radius     = 0.;
        std::vector<Fracture::Crack> cracks;
        for (const Fracture::Crack &crack : make_cracks(parameters))
          cracks.push_back(crack.with_moved_tips(i * da));
        Triangulation<2> triangulation(
            Triangulation<2>::limit_level_difference_at_vertices);
        PlateProblem problem(grown, cracks, triangulation);
        energies[i] = problem.solve().strain_energy;
      }
    const Fracture::ElasticPlane material(parameters.youngs_modulus,
                                          parameters.poissons_ratio,
                                          parameters.plane_stress);
    return Fracture::stress_intensity_of_energy(
        Fracture::energy_difference(
            energies, da, Fracture::held_quantity(parameters)),
        material.effective_modulus);
  }
} // namespace Morsel::FE
