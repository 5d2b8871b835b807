#include "breaking_recorder.h"
#include "recorder.h"
#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/materials/catalogue.h>
#include <morsel/measure/masticatory_performance.h>
#include <morsel/sph/body_cracks.h>

#include <deal.II/base/config.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace Morsel
{
  namespace
  {
    std::vector<Measure::Fragment>
    counted(const Measure::Fragments &fragments)
    {
      return {fragments.pieces.begin(),
              fragments.pieces.begin() + fragments.count};
    }


    std::string
    words(const StopReason reason)
    {
      switch (reason)
        {
          case StopReason::complete_failure:
            return "complete failure";
          case StopReason::maximum_closure:
            return "maximum closure";
          case StopReason::end_time:
            return "end time";
          default:
            return "interrupted";
        }
    }


    /// The catalogue's R of a material, 0 where it is not known.
    double
    fracture_energy_of(const Materials::MaterialParameters &material)
    {
      if (material.name == "inline")
        return 0.;
      const Materials::Catalogue catalogue(
          Materials::Catalogue::shipped_file());
      const auto *const entry = catalogue.find(material.name);
      return entry == nullptr ? 0. : entry->fracture_energy;
    }


    /// What relations between foods need of the material.
    void
    add_material(Output::Summary                     &summary,
                 const Materials::MaterialParameters &material)
    {
      summary.add_text("material", material.name);
      summary.add("youngs_modulus",
                  material.youngs_modulus,
                  "Pa",
                  "Young's modulus E of the food");
      if (material.toughness > 0.)
        summary.add("toughness",
                    material.toughness,
                    "J/m^3",
                    "area U under the food's stress-strain curve: the strength "
                    "is sqrt(2 E U) where none is given");
      if (const double energy = fracture_energy_of(material); energy > 0.)
        summary.add("fracture_energy",
                    energy,
                    "J/m^2",
                    "R, for a unit area of new crack, from the catalogue; no "
                    "part of the simulation");
    }
  } // namespace


  void
  Recorder::summarise_stroke(const StopReason reason)
  {
    const auto &plates = bite.get_plates();
    double      peak = 0., tangential = 0.;
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        peak       = std::max(peak, stroke.peak_force(p));
        tangential = std::max(tangential, stroke.peak_tangential_force(p));
        const std::string name = underscored(plates[p].body.name);
        summary.add("peak_occlusal_force_" + name,
                    stroke.peak_force(p),
                    "N",
                    "largest normal force on the " + plates[p].body.name);
      }
    summary.add_text("ended_by", words(reason));
    if (plates.empty())
      return;
    summary.add("peak_occlusal_force",
                peak,
                "N",
                "largest normal force on a plate over time");
    summary.add("peak_tangential_force",
                tangential,
                "N",
                "largest tangential force on a plate over time");
    summary.add("occlusal_force_time_of_peak",
                stroke.time_of_peak(),
                "s",
                "when the mean normal force of the plates was largest");
    summary.add("strain_at_peak",
                stroke.strain_at_peak(),
                "1",
                "nominal strain at the peak of the force");
    if (const auto stiffness = stroke.stiffness())
      summary.add("nominal_stiffness",
                  *stiffness,
                  "Pa",
                  "slope of nominal stress over nominal strain between 20 and "
                  "60 % of the peak");

    const bool can_fail = bite.food().can_fail();
    if (const auto error = stroke.compressive_strength_error())
      {
        const double prescribed =
            scene.particle_bodies.front().material.compressive_strength;
        summary.add("compressive_strength",
                    stroke.compressive_strength(),
                    "Pa",
                    "peak nominal axial stress: mean of the plates' normal "
                    "forces over the initial loaded area",
                    prescribed,
                    *error);
        summary.add("compressive_strength_error",
                    *error,
                    "1",
                    "compressive strength relative to the prescribed one");
      }
    else
      summary.add("peak_nominal_stress",
                  stroke.compressive_strength(),
                  "Pa",
                  "largest mean of the plates' normal forces over the initial "
                  "loaded area");
    if (const auto ratio = stroke.kinetic_over_strain_energy())
      {
        summary.add("kinetic_over_strain_energy_before_peak",
                    *ratio,
                    "1",
                    "kinetic over strain energy at 95 % of the peak: below "
                    "0.05 the loading was quasi-static");
        summary.add_text("loading",
                         *ratio < 0.05 ? "quasi-static" : "not quasi-static");
      }
    summarise_mass_scaling();
    if (can_fail)
      {
        summary.add(
            "complete_failure",
            stroke.failed_completely() ? 1. : 0.,
            "1",
            "1 if the mean force fell below " +
                std::to_string(scene.stop.residual_force).substr(0, 4) +
                " of its peak and the plates then closed on by the given "
                "share of the height without a higher peak, else 0");
        if (const auto time = stroke.time_of_failure())
          summary.add("time_of_failure",
                      *time,
                      "s",
                      "when the mean force first fell below its residual share "
                      "after the peak");
      }
  }


  void
  Recorder::summarise_fragments()
  {
    if (!bite.food().can_fail())
      return;
    const auto pieces = counted(fragments);
    const auto performance =
        Measure::masticatory_performance(counted(intact), pieces);
    summary.add(
        "fragment_count",
        fragments.count,
        "1",
        "pieces of at least " +
            std::to_string(100. * scene.measures.fragment_share).substr(0, 4) +
            " % of the mass");
    summary.add("largest_fragment_share",
                fragments.largest_share(),
                "1",
                "mass share of the largest fragment");
    summary.add("failed_share",
                fragments.dust_share,
                "1",
                "mass share of failed particles (dust)");
    summary.add("crumb_share",
                fragments.crumb_share,
                "1",
                "mass share of pieces too small to count");
    summary.add("masticatory_performance",
                performance.largest_fragment,
                "1/sqrt(mm)",
                "T4-4, S2 of the largest fragment (thesis)");
    summary.add("masticatory_performance_all_fragments",
                performance.all_fragments,
                "1/sqrt(mm)",
                "T4-4, S2 of all fragments together (Agrawal et al. 1997)");
    const auto &body = scene.particle_bodies.front();
    add_first_failure(summary, *breakage, "");
    add_crack_growth(summary,
                     bite.food(),
                     *breakage,
                     tip_suffixes(SPH::cracks_of(body), body, false));
  }


  void
  Recorder::summarise_ledgers()
  {
    const auto &e = energy.last();
    summary.add("strain_energy", e.strain, "J", "recoverable, at the end");
    summary.add("hourglass_energy",
                e.hourglass,
                "J",
                "in the residual of the linear fit, at the end");
    summary.add("kinetic_energy", e.kinetic, "J", "at the end");
    summary.add("contact_energy",
                e.contact,
                "J",
                "recoverable in contact with plates, at the end");
    summary.add("granular_energy",
                e.granular,
                "J",
                "recoverable in failed food, at the end");
    summary.add("external_work",
                e.external_work,
                "J",
                "done by the plates on the food");
    summary.add("dissipated_energy",
                e.dissipated(),
                "J",
                "by damage, broken bonds, viscosity and friction");
    summary.add("damage_energy",
                e.dissipated_damage,
                "J",
                "dissipated by damage growth");
    summary.add("bond_energy",
                e.dissipated_bonds,
                "J",
                "released when bonds were cut (negative: stored)");
    summary.add("viscous_energy",
                e.dissipated_viscosity,
                "J",
                "dissipated by artificial viscosity");
    summary.add("friction_energy",
                e.dissipated_friction + e.dissipated_granular_friction,
                "J",
                "dissipated by friction on plates and in failed food");
    summary.add("energy_balance_error",
                energy.error_at_end(),
                "1",
                "closing error of the energy ledger over its largest term, "
                "at the end");
    summary.add("energy_balance_error_at_peak",
                energy.error_at_peak(),
                "1",
                "the same at the peak of the force");
    summary.add("energy_balance_error_largest",
                energy.largest_error(),
                "1",
                "the same at its worst");
    summary.add(
        "momentum_error",
        momentum.largest_error(),
        "1",
        "change of linear momentum that the plates' impulses do not "
        "explain over the largest sum of masses times speeds or impulse");
  }


  void
  Recorder::summarise_run()
  {
    summary.add(
        "deepest_penetration", deepest, "m", "of a particle into a plate");
    summary.add("inverted_particle_count",
                most_inverted,
                "1",
                "particles turned inside out at any sample: must be 0");
    summary.add("cell_count",
                bite.food().get_host().n_cells(),
                "1",
                "of the background mesh that hosts the particles");
    summary.add("neighbours_per_particle",
                bite.food().neighbours_per_particle(),
                "1",
                "pairs of the reference configuration");
    summary.add("seed", scene.seed, "1", "of the flaws");
    add_loop_costs(summary,
                   {static_cast<double>(bite.particle_count()),
                    bite.step(),
                    bite.time_step(),
                    bite.time(),
                    log.wall_time(),
                    log.loop_wall_time()});
    rank_load.summarise(
        summary, log, bite.get_plates().empty() ? 0. : stroke.time_of_peak());
    add_provenance(
        summary, scene.title, scene.name, scene.parameters_hash, communicator);
    add_material(summary, scene.particle_bodies.front().material);
  }


  void
  Recorder::summarise_effects()
  {
    add_effects(summary, effects_of(scene), log);
  }
} // namespace Morsel
