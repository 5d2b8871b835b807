#include "plate_summary.h"

#include <morsel/core/parameters.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture/energy_release.h>

#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/utilities.h>

namespace Morsel
{
  using Fracture::StressIntensity;

  namespace
  {
    const char *const unit = "Pa sqrt(m)";


    /// "" for the first tip of the first crack, "_tip1", "_crack1_tip0" else.
    std::string
    tip_suffix(const Fracture::CrackTip &tip, const unsigned int number)
    {
      std::string suffix;
      if (tip.crack > 0)
        suffix += "_crack" + std::to_string(tip.crack);
      if (tip.crack > 0 || number > 0)
        suffix += "_tip" + std::to_string(number);
      return suffix;
    }


    std::optional<double>
    reference_of(const std::vector<double> &references, const unsigned int tip)
    {
      if (tip < references.size() && references[tip] != 0.)
        return references[tip];
      return std::nullopt;
    }


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
  } // namespace


  void
  add_tips(Output::Summary                        &summary,
           const Fracture::PlateScene             &plate,
           const std::vector<Fracture::Crack>     &cracks,
           const std::vector<Fracture::TipResult> &results)
  {
    const auto   tips   = Fracture::collect_tips(cracks);
    unsigned int number = 0;
    for (unsigned int t = 0; t < results.size(); ++t)
      {
        number = t > 0 && tips[t].crack == tips[t - 1].crack ? number + 1 : 0;
        const std::string     suffix = tip_suffix(tips[t], number);
        const StressIntensity k      = results[t].statistics.mean;
        summary.add("stress_intensity_I" + suffix,
                    k.mode_I,
                    unit,
                    "K_I by interaction integral, mean over the rings",
                    reference_of(plate.reference_I, t));
        summary.add("stress_intensity_II" + suffix,
                    k.mode_II,
                    unit,
                    "K_II by interaction integral, mean over the rings",
                    reference_of(plate.reference_II, t));
        add_rings(summary, results[t], suffix);
        summary.add("energy_release_rate" + suffix,
                    results[t].energy_release.back(),
                    "J/m^2",
                    "J over the largest ring");
        add_two_directions(summary, plate, results[t], suffix);
      }
    const double formula = Fracture::formula_stress_intensity(plate, cracks);
    if (formula != 0. && !results.empty())
      summary.add("stress_intensity_I_over_formula",
                  results[0].statistics.mean.mode_I / formula,
                  "1",
                  "ratio to the handbook formula T3-48");
  }


  void
  add_observed_points(
      Output::Summary                             &summary,
      const Fracture::PlateScene                  &plate,
      const std::function<std::vector<Fracture::DisplacementSample>(
          const std::vector<dealii::Point<2>> &)> &sample)
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


  void
  add_provenance(Output::Summary            &summary,
                 const Fracture::PlateScene &plate,
                 const std::string          &used_parameters)
  {
    const MPI_Comm                         communicator = MPI_COMM_WORLD;
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    summary.add("peak_memory",
                dealii::Utilities::MPI::max(1024. * memory.VmHWM, communicator),
                "B",
                "largest resident size of a rank");
    summary.add("rank_count",
                dealii::Utilities::MPI::n_mpi_processes(communicator),
                "1",
                "MPI ranks");
    summary.add("thread_count",
                dealii::MultithreadInfo::n_threads(),
                "1",
                "threads per rank");
    summary.add_text("kind", "cracked plate");
    summary.add_text("title", plate.title);
    summary.add_text("scene", plate.name);
    summary.add_text("method", plate.method);
    summary.add_text("parameters_hash", text_hash(used_parameters));
    summary.add_text("morsel_version", MORSEL_VERSION);
    summary.add_text("deal_ii_version", DEAL_II_PACKAGE_VERSION);
  }
} // namespace Morsel
