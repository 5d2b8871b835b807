#include "recorder.h"

#include <morsel/core/suggestions.h>
#include <morsel/measure/fragment_sizes.h>
#include <morsel/measure/whole_body.h>

namespace Morsel
{
  std::optional<Measure::FracturePattern>
  Recorder::find_pattern() const
  {
    const auto &food = bite.food();
    if (!food.can_fail())
      return std::nullopt;
    const auto &p         = food.get_particles();
    const auto  positions = Measure::of_whole_body(food, p.reference);
    const auto  areas     = Measure::of_whole_body(food, p.area);
    const auto  damage    = Measure::of_whole_body(food, p.damage);
    return Measure::fracture_pattern(dealii::make_array_view(positions),
                                     dealii::make_array_view(areas),
                                     dealii::make_array_view(damage),
                                     bite.closing_axis(),
                                     p.spacing);
  }


  void
  Recorder::summarise_break()
  {
    if (!bite.food().can_fail() || bite.get_plates().empty())
      return;
    summary.add("dissipated_energy_at_peak",
                energy.at_peak().dissipated(),
                "J",
                "by damage, broken bonds, viscosity and friction up to the "
                "peak of the force");
    summary.add("external_work_at_peak",
                energy.at_peak().external_work,
                "J",
                "done by the plates on the food up to the peak of the force");
    if (const auto residual = stroke.residual_strength())
      {
        summary.add("residual_strength",
                    *residual,
                    "Pa",
                    "mean nominal stress over the last part of the stroke: "
                    "the second half of the closure after the force has "
                    "fallen to half of its peak");
        summary.add("residual_strength_share",
                    *residual / stroke.compressive_strength(),
                    "1",
                    "the same over the peak");
      }
    if (const auto drop = stroke.strain_from_peak_to_half())
      summary.add("strain_from_peak_to_half",
                  *drop,
                  "1",
                  "nominal strain from the peak of the force to where it has "
                  "fallen to half");
    if (const auto brittleness = stroke.brittleness())
      summary.add("brittleness",
                  *brittleness,
                  "1",
                  "strain at the peak over that where the force has fallen to "
                  "half: 1 for a fall at once");
    summarise_pattern(
        pattern_at_half, "", "when the force had fallen to half of its peak");
    summarise_pattern(find_pattern(), "_at_end", "at the end");
  }


  void
  Recorder::summarise_pattern(
      const std::optional<Measure::FracturePattern> &pattern,
      const std::string                             &suffix,
      const std::string                             &moment)
  {
    if (!pattern)
      return;
    summary.add("fracture_angle" + suffix,
                pattern->angle,
                "degrees",
                "between the direction of damaged bands and that of loading " +
                    moment + ", 0 = axial splitting; see the sharpness");
    summary.add("fracture_sharpness" + suffix,
                pattern->sharpness,
                "1",
                "what strips along that direction explain of the variance of "
                "damage more than others " +
                    moment +
                    ": above 0.5 one straight band, below 0.05 no direction");
    summary.add("mean_damage" + suffix,
                pattern->damaged_share,
                "1",
                "of all particles " + moment);
  }


  void
  Recorder::summarise_fragment_sizes()
  {
    if (!bite.food().can_fail())
      return;
    const std::vector<double> shares = {0.05, 0.1, 0.2, 0.5};
    const auto sizes = Measure::fragment_sizes(fragments, shares);
    summary.add("fragment_mean_size",
                sizes.mass_weighted_mean,
                "m",
                "mean diameter of pieces (of the circle of equal area), each "
                "weighted with its mass; dust counts as 0");
    summary.add("fragment_median_size",
                sizes.median,
                "m",
                "diameter of pieces that splits the mass in halves; dust "
                "counts as 0");
    for (std::size_t k = 0; k < shares.size(); ++k)
      {
        const std::string percent =
            std::to_string(static_cast<int>(100. * shares[k] + 0.5));
        summary.add("pieces_above_" + percent + "_percent",
                    sizes.count_above[k],
                    "1",
                    "pieces with a diameter above " + percent +
                        " % of the whole food's (circles of equal area)");
      }
  }


  void
  Recorder::summarise_mass_scaling()
  {
    const double factor = scene.time.inertia_factor;
    if (factor == 1.)
      return;
    summary.add("mass_scaling",
                factor,
                "1",
                "density that inertia sees over the material's");
    const auto largest = stroke.largest_kinetic_over_strain_energy();
    if (!largest)
      return;
    summary.add("largest_kinetic_over_strain_energy",
                *largest,
                "1",
                "kinetic over strain energy at its largest between half and "
                "95 % of the peak, with the scaled mass");
    const double ratio = *stroke.kinetic_over_strain_energy();
    const double share = scene.time.kinetic_share;
    if (ratio <= share)
      return;
    // The share goes as the mass.
    const double allowed = factor * share / ratio;
    log.warning("At 95 % of the peak of the force kinetic energy was " +
                number_text(ratio) +
                " of the strain energy, more than 'Time/Kinetic share' = " +
                number_text(share) + ": inertia shows. " +
                (allowed >= 1.
                     ? "'Time/Mass scaling' = " + number_text(allowed) +
                           " would keep below."
                     : "Without scaled mass it would still be about " +
                           number_text(ratio / factor) +
                           "; slower plates lower it."));
  }
} // namespace Morsel
