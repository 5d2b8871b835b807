#include "xfem_plan.h"

#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <unistd.h>

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


    /// Resident memory [B]: program, factorisation (n log n entries by nested
    /// dissection), and the picture's text; measured on M1 for degrees 1 to 8
    /// and 7,000 to 150,000 unknowns, good to a third.
    double
    predicted_memory(const FE::PlateParameters &plate,
                     const double               n_cells,
                     const double               unknowns)
    {
      const double parts = plate.degree > 1 ? 16. : 1.;
      return 1.8e8 + 110. * unknowns * std::log2(unknowns) +
             1.4e3 * parts * n_cells;
    }


    /// Time of the whole run [s] on one core, from the same runs.
    double
    predicted_time(const double unknowns)
    {
      return 0.2 + 2.2e-5 * unknowns + 2e-8 * std::pow(unknowns, 1.5);
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
          effects.push_back({name, on, reason, 0.});
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
    const double needed =
        predicted_memory(plate, 1. * plate.cells_x * plate.cells_y, unknowns);
    const double present =
        1. * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGE_SIZE);
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


  std::string
  describe_xfem_run(const FE::PlateParameters          &plate,
                    const std::vector<Fracture::Crack> &cracks)
  {
    Triangulation<2> triangulation(
        Triangulation<2>::limit_level_difference_at_vertices);
    FE::PlateProblem problem(plate, cracks, triangulation);
    problem.set_up();
    const double n_cells  = triangulation.n_active_cells();
    const double unknowns = problem.get_space().n_free_dofs();
    // Every marked cell makes way for four.
    const double growth = 1. + 3. * plate.refined_share;
    double       time = 0., last = unknowns;
    for (unsigned int step = 0; step <= plate.adaptive_steps; ++step)
      {
        last = unknowns * std::pow(growth, step);
        time += predicted_time(last);
      }
    if (plate.energy_growth > 0.)
      time += 2. * predicted_time(unknowns);

    std::ostringstream text;
    text << "Scene '" << plate.name << "' is sound. Effects:\n";
    for (const Output::Effect &effect : effects_of(plate, cracks))
      text << (effect.on ? "  on   " : "  off  ") << std::left << std::setw(46)
           << effect.name << "  (" << effect.reason << ")\n";
    text << "Cells            " << n_cells << " of degree " << plate.degree
         << '\n'
         << "Unknowns         " << unknowns << '\n';
    if (plate.adaptive_steps > 0)
      text << "At the end       about "
           << std::llround(n_cells * last / unknowns) << " cells, "
           << std::llround(last) << " unknowns after " << plate.adaptive_steps
           << " adaptive step(s)\n";
    text << "Predicted memory about "
         << std::llround(
                1e-6 * predicted_memory(plate, n_cells * last / unknowns, last))
         << " MB\n"
         << std::setprecision(2) << "Predicted time   about " << time << " s\n";
    return text.str();
  }
} // namespace Morsel
