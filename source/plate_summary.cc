#include "plate_summary.h"

#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/parameters.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture/energy_release.h>

#include <deal.II/base/utilities.h>

#include <sstream>

namespace Morsel
{
  using Fracture::StressIntensity;
  namespace Utilities = dealii::Utilities;

  namespace
  {
    const char *const unit = stress_intensity_unit;


    void
    add_rings(Output::Summary           &summary,
              const Fracture::TipResult &result,
              const std::string         &suffix)
    {
      summary.add("stress_intensity_I_spread" + suffix,
                  result.statistics.spread.mode_I,
                  unit,
                  "largest minus smallest K_I over the rings");
      summary.add("stress_intensity_II_spread" + suffix,
                  result.statistics.spread.mode_II,
                  unit,
                  "largest minus smallest K_II over the rings");
      summary.add("largest_ring_radius" + suffix,
                  result.rings.back().outer_radius,
                  "m",
                  "outer radius of the largest ring");
      summary.add("rings_on_blending_layer" + suffix,
                  result.n_rings_on_blending_layer,
                  "1",
                  "rings, of " + std::to_string(result.rings.size()) +
                      ", that overlap the layer where the tip functions fade "
                      "out");
    }


    /// T3-15, from the largest ring's J vector.
    void
    add_two_directions(Output::Summary            &summary,
                       const Fracture::PlateScene &plate,
                       const Fracture::TipResult  &result,
                       const std::string          &suffix)
    {
      if (result.energy_release_across.empty())
        return;
      const Fracture::ElasticPlane material(
          plate.youngs_modulus, plate.poissons_ratio, plate.plane_stress);
      const StressIntensity k =
          Fracture::two_direction_recipe(result.energy_release.back(),
                                         result.energy_release_across.back(),
                                         material.effective_modulus);
      const std::string how =
          " by the thesis's recipe T3-15 from the two components of the J "
          "vector, for K_I >= |K_II|: an approximation if G_2 were that of a "
          "kinked crack";
      summary.add("stress_intensity_I_two_directions" + suffix,
                  k.mode_I,
                  unit,
                  "K_I" + how);
      summary.add("stress_intensity_II_two_directions" + suffix,
                  k.mode_II,
                  unit,
                  "K_II" + how);
      summary.add("energy_release_rate_across" + suffix,
                  result.energy_release_across.back(),
                  "J/m^2",
                  "J_2, the component of the J vector across the crack");
    }


    void
    add_tips(Output::Summary                        &summary,
             const Fracture::PlateScene             &plate,
             const std::vector<Fracture::Crack>     &cracks,
             const std::vector<Fracture::TipResult> &results)
    {
      const auto suffixes = tip_suffixes(Fracture::collect_tips(cracks));
      for (unsigned int t = 0; t < results.size(); ++t)
        {
          add_stress_intensity(summary,
                               results[t],
                               suffixes[t],
                               {plate.reference_I, plate.reference_II});
          add_rings(summary, results[t], suffixes[t]);
          summary.add("energy_release_rate" + suffixes[t],
                      results[t].energy_release.back(),
                      "J/m^2",
                      "J over the largest ring");
          add_two_directions(summary, plate, results[t], suffixes[t]);
        }
      const double formula = Fracture::formula_stress_intensity(plate, cracks);
      if (formula != 0. && !results.empty())
        summary.add("stress_intensity_I_over_formula",
                    results[0].statistics.mean.mode_I / formula,
                    "1",
                    "ratio to the handbook formula T3-48");
    }


    void
    add_energy_route(Output::Summary            &summary,
                     const Fracture::PlateScene &plate,
                     const double                stress_intensity)
    {
      const bool by_traction =
          Fracture::held_quantity(plate) == Fracture::HeldQuantity::traction;
      summary.add("stress_intensity_energy",
                  stress_intensity,
                  unit,
                  "sqrt(E' G), G = " + std::string(by_traction ? "+" : "-") +
                      "dU/da by the energy difference T3-47 with da = " +
                      number_text(plate.energy_growth) +
                      " m, all tips together; one-sided: on M1 it is 0.952, "
                      "0.994, 0.9985 and 0.9996 of K at da/a = 0.5, 0.2, 0.1 "
                      "and 0.05");
      summary.add_text("loading", by_traction ? "traction" : "displacement");
    }


    /// Displacement and stress at the scene's observed points.
    void
    add_observed_points(Output::Summary              &summary,
                        const Fracture::PlateScene   &plate,
                        const Fracture::FieldSampler &sample)
    {
      const auto                    points = Fracture::observed_points(plate);
      std::vector<dealii::Point<2>> places;
      for (const Fracture::ObservedPoint &point : points)
        places.push_back(point.place);
      const Fracture::ElasticPlane material(
          plate.youngs_modulus, plate.poissons_ratio, plate.plane_stress);
      const auto samples = sample(places);
      for (unsigned int k = 0; k < points.size(); ++k)
        {
          const std::string name = "_" + points[k].name;
          const auto        u    = samples[k].value;
          const auto        s    = material.stress(samples[k].gradient);
          const std::string at   = "at (" + number_text(places[k][0]) + ", " +
                                 number_text(places[k][1]) + ") m";
          summary.add("displacement_x" + name, u[0], "m", at);
          summary.add("displacement_y" + name, u[1], "m", at);
          summary.add("stress_xx" + name, s[0][0], "Pa", at);
          summary.add("stress_yy" + name, s[1][1], "Pa", at);
          summary.add("stress_xy" + name, s[0][1], "Pa", at);
        }
    }


    void
    tell_tips(RunLog                                 &log,
              const Fracture::PlateScene             &plate,
              const std::vector<Fracture::TipResult> &tips)
    {
      for (const Fracture::TipResult &tip : tips)
        {
          std::ostringstream text;
          text.precision(8);
          text << "Tip " << tip.tip << ": K_I = " << tip.statistics.mean.mode_I
               << ", K_II = " << tip.statistics.mean.mode_II
               << " Pa sqrt(m), spread " << tip.statistics.spread.mode_I
               << '\n';
          log << text.str();
          if (!tip.remark.empty())
            log.warning(tip.remark);
        }
      if (tips.empty())
        log << "No crack tip in '" << plate.name
            << "': no stress intensity factors.\n";
    }
  } // namespace


  void
  start_log(RunLog                     &log,
            const Fracture::PlateScene &plate,
            const RunOptions           &options,
            const std::string          &used_parameters)
  {
    log << (plate.title.empty() ? plate.name : plate.title) << '\n';
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      write_atomically(options.output_directory + "/used.prm", used_parameters);
  }


  void
  finish_run(const PlateRun      &run,
             const dealii::Timer &whole,
             RunLog              &log,
             const std::string   &folder,
             const std::string   &used_parameters)
  {
    Output::Summary summary;
    add_tips(summary, run.plate, run.cracks, run.tips);
    add_observed_points(summary, run.plate, run.sample);
    dealii::Timer energy;
    if (run.plate.energy_growth > 0.)
      add_energy_route(summary, run.plate, run.energy_route());
    const double energy_time = energy.wall_time();
    run.add_costs(summary);
    if (run.plate.energy_growth > 0.)
      summary.add_part("energy difference", energy_time);
    log << run.costs_in_words << ", " << whole.wall_time() << " s\n";
    tell_tips(log, run.plate, run.tips);

    dealii::Timer output;
    run.write_fields();
    summary.add_part("output", output.wall_time());
    for (const Output::Effect &effect : run.effects)
      summary.add_effect(effect);
    summary.add("wall_time", whole.wall_time(), "s", "whole run");
    summary.add_text("kind", "cracked plate");
    add_provenance(summary,
                   run.plate.title,
                   run.plate.name,
                   text_hash(used_parameters),
                   MPI_COMM_WORLD);
    summary.add_text("method", run.plate.method);
    summary.add_text("solver", run.solver);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      summary.write(folder + "/summary.json");
  }
} // namespace Morsel
