#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/parameters.h>
#include <morsel/output/atomic_file.h>
#include <morsel/output/summary.h>
#include <morsel/particle_plate_run.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

namespace Morsel
{
  using namespace dealii;

  namespace
  {
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


    void
    add_tips(Output::Summary                    &summary,
             const Fracture::PlateScene         &plate,
             const std::vector<Fracture::Crack> &cracks,
             const std::vector<SPH::TipResult>  &results)
    {
      const auto   tips   = Fracture::collect_tips(cracks);
      unsigned int number = 0;
      for (unsigned int t = 0; t < results.size(); ++t)
        {
          number = t > 0 && tips[t].crack == tips[t - 1].crack ? number + 1 : 0;
          const std::string suffix    = tip_suffix(tips[t], number);
          const auto       &r         = results[t].statistics;
          const auto        reference = [&](const double value) {
            return t == 0 && value != 0. ? std::optional<double>(value)
                                                : std::nullopt;
          };
          summary.add("stress_intensity_I" + suffix,
                      r.mean.mode_I,
                      "Pa sqrt(m)",
                      "K_I by interaction integral, mean over the rings",
                      reference(plate.reference_I));
          summary.add("stress_intensity_II" + suffix,
                      r.mean.mode_II,
                      "Pa sqrt(m)",
                      "K_II by interaction integral, mean over the rings",
                      reference(plate.reference_II));
          summary.add("stress_intensity_I_spread" + suffix,
                      r.spread.mode_I,
                      "Pa sqrt(m)",
                      "largest minus smallest K_I over the rings");
          summary.add("stress_intensity_II_spread" + suffix,
                      r.spread.mode_II,
                      "Pa sqrt(m)",
                      "largest minus smallest K_II over the rings");
        }
      const double formula = Fracture::formula_stress_intensity(plate, cracks);
      if (formula != 0. && !results.empty())
        summary.add("stress_intensity_I_over_formula",
                    results[0].statistics.mean.mode_I / formula,
                    "1",
                    "ratio to the handbook formula T3-48");
    }


    void
    add_costs(Output::Summary &summary, const SPH::PlateResults &results)
    {
      summary.add(
          "strain_energy", results.strain_energy, "J/m", "per metre of depth");
      summary.add("hourglass_energy",
                  results.hourglass_energy,
                  "J/m",
                  "part of the strain energy in the residual of the local "
                  "linear fit");
      summary.add("external_work",
                  results.external_work,
                  "J/m",
                  "traction times displacement, per metre of depth");
      summary.add("particle_count", results.n_particles, "1", "particles");
      summary.add("neighbours_per_particle",
                  results.n_neighbours,
                  "1",
                  "in the discrete gradient, mean");
      summary.add("dof_count", results.solve.n_dofs, "1", "unknowns");
      summary.add("equilibrium_residual",
                  results.solve.residual,
                  "1",
                  "forces out of balance over tractions and reactions");
      summary.add("solver_iterations",
                  results.solve.n_iterations,
                  "1",
                  "of conjugate gradients, in all steps of the multipliers");
      summary.add("multiplier_steps",
                  results.solve.n_multiplier_steps,
                  "1",
                  "of the supports");
      summary.add("condition_number",
                  results.solve.condition_number,
                  "1",
                  "of the preconditioned stiffness, by Lanczos");
      summary.add("support_gap",
                  results.solve.support_gap,
                  "1",
                  "largest displacement of a held facet over the largest one");
      summary.add(
          "wall_time_loop",
          results.cloud_time + results.operator_time +
              results.solve.setup_time + results.solve.solution_time +
              results.tip_time,
          "s",
          "cloud, gradient, preconditioner, solution and stress intensity");
      summary.add_part("cloud", results.cloud_time);
      summary.add_part("gradient", results.operator_time);
      summary.add_part("preconditioner", results.solve.setup_time);
      summary.add_part("solution", results.solve.solution_time);
      summary.add_part("stress intensity", results.tip_time);
    }


    void
    write_rings(const std::string                 &file_name,
                const std::vector<SPH::TipResult> &tips)
    {
      std::ostringstream out;
      out.precision(12);
      out << "tip,inner_radius_m,outer_radius_m,K_I_Pa_sqrt_m,K_II_Pa_sqrt_m,"
             "J_J_per_m2\n";
      for (const SPH::TipResult &tip : tips)
        for (unsigned int i = 0; i < tip.rings.size(); ++i)
          out << tip.tip << ',' << tip.rings[i].inner_radius << ','
              << tip.rings[i].outer_radius << ',' << tip.by_ring[i].mode_I
              << ',' << tip.by_ring[i].mode_II << ',' << tip.energy_release[i]
              << '\n';
      Output::write_atomically(file_name, out.str());
    }
  } // namespace


  void
  run_particle_plate(const CommandLine          &command_line,
                     const SPH::PlateParameters &plate,
                     const std::string          &used)
  {
    Timer whole;
    if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError(
          "'Method = SPH' runs a cracked plate on one rank only, "
          "but " +
          std::to_string(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
          " are given: leave mpirun out.");
    check(plate);
    const auto cracks = make_cracks(plate);
    if (command_line.run.validate_only)
      {
        std::cout << "Scene '" << plate.name << "' is sound: about "
                  << plate.particles_x * plate.particles_y << " particles, "
                  << cracks.size() << " crack(s), "
                  << Fracture::collect_tips(cracks).size() << " tip(s).\n";
        return;
      }

    SPH::PlateProblem        problem(plate, cracks);
    const SPH::PlateResults &results = problem.run();
    Output::Summary          summary;
    add_tips(summary, plate, cracks, results.tips);
    if (plate.energy_growth > 0.)
      summary.add("stress_intensity_energy",
                  SPH::energy_route(plate, results.strain_energy),
                  "Pa sqrt(m)",
                  "sqrt(E' G) from the energy difference T3-47 (all tips "
                  "together; one-sided, biased low by some (da/a)^2)");
    add_costs(summary, results);

    std::string folder = command_line.run.output_directory;
    if (folder.empty())
      folder = "output/" + plate.name;
    prepare_output_directory(folder);
    RunLog log(folder + "/run.log", command_line.run.quiet, true);
    log << (plate.title.empty() ? plate.name : plate.title) << '\n'
        << results.n_particles << " particles, " << whole.wall_time() << " s\n";
    for (const SPH::TipResult &tip : results.tips)
      {
        std::ostringstream text;
        text.precision(8);
        text << "Tip " << tip.tip << ": K_I = " << tip.statistics.mean.mode_I
             << ", K_II = " << tip.statistics.mean.mode_II
             << " Pa sqrt(m), spread " << tip.statistics.spread.mode_I << '\n';
        log << text.str();
        if (!tip.remark.empty())
          log.warning(tip.remark);
      }

    write_rings(folder + "/stress_intensity.csv", results.tips);
    Output::write_atomically(folder + "/used.prm", used);
    summary.add_text("title", plate.title);
    summary.add_text("solver",
                     "conjugate gradients, preconditioned by a Cholesky "
                     "factorisation over Voronoi neighbours");
    summary.add_text("deal_ii_version", DEAL_II_PACKAGE_VERSION);
    summary.add_text("parameters_hash", text_hash(used));
    summary.add("wall_time", whole.wall_time(), "s", "whole run");
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    summary.add("peak_memory", 1024. * memory.VmHWM, "B", "resident");
    summary.write(folder + "/summary.json");
  }
} // namespace Morsel
