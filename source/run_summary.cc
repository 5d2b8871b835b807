#include "run_summary.h"

#include <morsel/core/build.h>

#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Morsel
{
  std::string
  underscored(std::string name)
  {
    for (char &c : name)
      if (!std::isalnum(static_cast<unsigned char>(c)))
        c = '_';
    return name;
  }


  void
  add_loop_costs(Output::Summary &summary, const LoopCosts &costs)
  {
    summary.add("particle_count", costs.particle_count, "1", "");
    summary.add("step_count", costs.step_count, "1", "");
    summary.add("time_step", costs.time_step, "s", "");
    summary.add("simulated_time", costs.simulated_time, "s", "");
    summary.add("wall_time", costs.wall_time, "s", "whole run");
    summary.add("wall_time_loop", costs.loop_wall_time, "s", "time loop alone");
    summary.add("particle_steps_per_second",
                costs.particle_count * costs.step_count /
                    std::max(costs.loop_wall_time, 1e-9),
                "1/s",
                "particles times steps over the loop's wall time");
  }


  void
  add_static_report(Output::Summary &summary, const SPH::StaticReport &report)
  {
    const auto add =
        [&](const char *name, const double value, const char *meaning) {
          summary.add(name, value, "1", meaning);
        };
    add("dof_count", report.n_dofs, "unknowns");
    add("equilibrium_residual",
        report.residual,
        "forces out of balance over loads and reactions");
    add("support_gap",
        report.support_gap,
        "largest error of a facet's prescribed mean displacement over the "
        "largest displacement");
    add("solver_iterations",
        report.n_iterations,
        "of conjugate gradients, in all steps of the multipliers");
    add("multiplier_steps", report.n_multiplier_steps, "of the supports");
    add("condition_number",
        report.condition_number,
        "of the preconditioned stiffness, by Lanczos");
  }


  void
  add_effects(Output::Summary            &summary,
              std::vector<Output::Effect> effects,
              const RunLog               &log)
  {
    const auto   parts = log.wall_times();
    const double loop  = log.loop_wall_time();
    for (Output::Effect &effect : effects)
      {
        const auto part =
            std::find_if(parts.begin(), parts.end(), [&](const auto &p) {
              return p.first == effect.part;
            });
        if (effect.on && effect.fills_part && part != parts.end())
          {
            effect.wall_time = part->second;
            effect.share     = loop > 0. ? part->second / loop : 0.;
          }
        summary.add_effect(effect);
      }
    for (const auto &part : parts)
      summary.add_part(part.first, part.second);
  }


  Output::Effect
  effect_of_grains(const Scene::ParticleBody &body)
  {
    const bool modulus  = body.grains.scatter_modulus();
    const bool strength = body.grains.scatter_strength();
    return {std::string("heterogeneity by grains") +
                (modulus && strength ? " (modulus, strength)"
                 : modulus           ? " (modulus)"
                 : strength          ? " (strength)"
                                     : ""),
            modulus || strength,
            "Body " + body.name + "/Grains/Size"};
  }


  void
  add_provenance(Output::Summary   &summary,
                 const std::string &title,
                 const std::string &scene,
                 const std::string &parameters_hash,
                 const MPI_Comm     communicator)
  {
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
    summary.add_text("title", title);
    summary.add_text("scene", scene);
    summary.add_text("parameters_hash", parameters_hash);
    summary.add_text("morsel_version", MORSEL_VERSION);
    summary.add_text("deal_ii_version", DEAL_II_PACKAGE_VERSION);
  }
} // namespace Morsel
