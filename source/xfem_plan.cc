#include "xfem_plan.h"

#include "costs.h"

#include <morsel/core/errors.h>
#include <morsel/core/machine.h>
#include <morsel/core/suggestions.h>

#include <algorithm>
#include <cmath>

namespace Morsel
{
  using namespace dealii;

  namespace
  {
    /// Unknowns of the displacement without enrichment and grading.
    double
    least_unknowns(const FE::PlateParameters &plate)
    {
      return 2. * (1. * plate.degree * plate.cells_x + 1.) *
             (1. * plate.degree * plate.cells_y + 1.);
    }


    Sizes
    sizes_of(const FE::PlateParameters &plate,
             const double               n_cells,
             const double               unknowns)
    {
      return {{"cells", n_cells},
              {"unknowns", unknowns},
              {"order", plate.degree + 1.},
              // The picture of a cell of higher degree has 4 x 4 parts.
              {"parts", (plate.degree > 1 ? 16. : 1.) * n_cells}};
    }
  } // namespace


  std::vector<Output::Effect>
  effects_of(const FE::PlateParameters          &plate,
             const std::vector<Fracture::Crack> &cracks)
  {
    const std::size_t n_tips  = Fracture::collect_tips(cracks).size();
    const bool        clamped = std::any_of(
        plate.support.begin(), plate.support.end(), [](const std::string &s) {
          return s == "clamp" || s == "displacement";
        });
    std::vector<Output::Effect> effects;
    const auto                  add =
        [&](const std::string &name, const bool on, const std::string &reason) {
          effects.push_back({name, on, reason});
        };
    add(std::string("elastic plate (") +
            (plate.plane_stress ? "plane stress" : "plane strain") + ")",
        true,
        "Material");
    add("jump enrichment along " + std::to_string(cracks.size()) + " crack(s)",
        !cracks.empty(),
        "Cracks");
    add("tip enrichment at " + std::to_string(n_tips) + " tip(s) " +
            (plate.enrichment_radius > 0.
                 ? "within " + number_text(plate.enrichment_radius) + " m"
                 : "in the tip's cells"),
        n_tips > 0,
        "XFEM/Enrichment radius");
    add("ramp (corrected XFEM)", n_tips > 0 && plate.ramp, "XFEM/Ramp");
    add("refinement towards clamped corners",
        clamped && plate.corner_refinements > 0,
        "XFEM/Corner refinements");
    add("refinement towards tips",
        n_tips > 0 && plate.tip_refinements > 0,
        "XFEM/Tip refinements");
    add("adaptive refinement", plate.adaptive_steps > 0, "XFEM/Adaptive steps");
    add("energy difference T3-47",
        plate.energy_growth > 0.,
        "Stress intensity/Energy growth");
    add("two directions T3-15",
        n_tips > 0 && plate.two_directions,
        "Stress intensity/Two directions");
    return effects;
  }


  void
  check_memory(const FE::PlateParameters &plate)
  {
    const double unknowns = least_unknowns(plate);
    const double needed   = Costs().of(
        "XFEM solution",
        "bytes",
        sizes_of(plate, 1. * plate.cells_x * plate.cells_y, unknowns));
    const double present = machine_memory();
    if (needed > present)
      throw InputError(
          "'XFEM/Cells along x' = " + std::to_string(plate.cells_x) +
          ", 'Cells along y' = " + std::to_string(plate.cells_y) +
          " and 'Degree' = " + std::to_string(plate.degree) + " make " +
          number_text(unknowns) + " unknowns, whose solution takes about " +
          number_text(std::round(1e-9 * needed)) + " GB; this machine has " +
          number_text(std::round(1e-9 * present)) +
          " GB: choose fewer cells or a lower degree.");
  }


  Prediction
  predict_xfem(const FE::PlateParameters          &plate,
               const std::vector<Fracture::Crack> &cracks)
  {
    Triangulation<2> triangulation(
        Triangulation<2>::limit_level_difference_at_vertices);
    FE::PlateProblem problem(plate, cracks, triangulation);
    problem.set_up();
    const double n_cells  = triangulation.n_active_cells();
    const double unknowns = problem.get_space().n_free_dofs();
    const Costs  costs;
    const auto   seconds = [&](const char *part, const double growth) {
      return costs.of(part,
                      "seconds",
                      sizes_of(plate, growth * n_cells, growth * unknowns));
    };
    // Every marked cell makes way for four.
    double growth = 1., solutions = seconds("XFEM solution", 1.);
    if (plate.energy_growth > 0.)
      solutions *= plate.adaptive_steps > 0 ? 4. : 3.;
    for (unsigned int step = 0; step < plate.adaptive_steps; ++step)
      {
        growth *= 1. + 3. * plate.refined_share;
        solutions += seconds("XFEM solution", growth);
      }

    Prediction prediction;
    prediction.scene    = plate.name;
    prediction.effects  = Output::effects_as_text(effects_of(plate, cracks));
    prediction.unknowns = growth * unknowns;
    prediction.steps    = 1. + plate.adaptive_steps;
    costs.predict_time(prediction,
                       Workload::finite_elements,
                       solutions + seconds("XFEM fields", growth));
    prediction.bytes =
        costs.of("XFEM solution",
                 "bytes",
                 sizes_of(plate, growth * n_cells, growth * unknowns));
    prediction.counts.emplace_back("Cells",
                                   number_text(n_cells) + " of degree " +
                                       std::to_string(plate.degree));
    prediction.count("Unknowns", unknowns);
    if (plate.adaptive_steps > 0)
      prediction.counts.emplace_back(
          "At the end",
          "about " + std::to_string(std::llround(growth * n_cells)) +
              " cells, " + std::to_string(std::llround(growth * unknowns)) +
              " unknowns after " + std::to_string(plate.adaptive_steps) +
              " adaptive step(s)");
    return prediction;
  }
} // namespace Morsel
