#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/log.h>
#include <morsel/core/parameters.h>
#include <morsel/fe/open_crack_output.h>
#include <morsel/fe/plate_problem.h>
#include <morsel/fracture_run.h>
#include <morsel/output/atomic_file.h>
#include <morsel/output/summary.h>

#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <deal.II/distributed/tria.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace Morsel
{
  using namespace dealii;

  namespace
  {
    std::vector<ParameterEntry>
    read_entries(const std::string              &scene_file,
                 const std::vector<std::string> &overrides)
    {
      std::vector<ParameterEntry> entries = read_parameter_file(scene_file);
      for (const std::string &text : overrides)
        entries.push_back(read_override(text));
      return entries;
    }


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
    add_tips(Output::Summary            &summary,
             const Fracture::PlateScene &plate,
             const FE::PlateProblem     &problem,
             const FE::PlateResults     &results)
    {
      const auto  &tips   = problem.get_space().get_tips();
      unsigned int number = 0;
      for (unsigned int t = 0; t < results.tips.size(); ++t)
        {
          number = t > 0 && tips[t].crack == tips[t - 1].crack ? number + 1 : 0;
          const std::string suffix    = tip_suffix(tips[t], number);
          const auto       &r         = results.tips[t].statistics;
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
      const double formula = Fracture::formula_stress_intensity(
          plate, problem.get_space().get_cracks());
      if (formula != 0. && !results.tips.empty())
        summary.add("stress_intensity_I_over_formula",
                    results.tips[0].statistics.mean.mode_I / formula,
                    "1",
                    "ratio to the handbook formula T3-48");
    }


    void
    add_costs(Output::Summary &summary, const FE::PlateResults &results)
    {
      summary.add(
          "strain_energy", results.strain_energy, "J/m", "per metre of depth");
      summary.add("external_work",
                  results.external_work,
                  "J/m",
                  "traction times displacement, per metre of depth");
      summary.add("cell_count", results.n_cells, "1", "active cells");
      summary.add(
          "dof_count", results.solve.n_dofs, "1", "free degrees of freedom");
      summary.add("wall_time_loop",
                  results.solve.assembly_time + results.solve.solve_time +
                      results.tip_time + results.space_time + results.mesh_time,
                  "s",
                  "mesh, space, assembly, solution and stress intensity");
      if (results.solve.n_iterations == 0)
        {
          summary.add("smallest_relative_pivot",
                      results.solve.smallest_pivot,
                      "1",
                      "of the factorisation; near 1e-14 the enrichment is "
                      "dependent");
          summary.add("dropped_pivots",
                      results.solve.n_dropped_pivots,
                      "1",
                      "unknowns set to zero by the factorisation");
        }
      if (results.solve.n_iterations > 0)
        {
          summary.add("solver_iterations",
                      results.solve.n_iterations,
                      "1",
                      "conjugate gradients of the last solution");
          summary.add("condition_number",
                      results.solve.condition_number,
                      "1",
                      "of the preconditioned system, by Lanczos");
        }
      summary.add_part("mesh", results.mesh_time);
      summary.add_part("space", results.space_time);
      summary.add_part("assembly", results.solve.assembly_time);
      summary.add_part("solution", results.solve.solve_time);
      summary.add_part("stress intensity", results.tip_time);
      for (unsigned int i = 0; i < results.estimates.size(); ++i)
        summary.add("error_estimate_step" + std::to_string(i),
                    results.estimates[i],
                    "Pa m",
                    "residual estimate before adaptive step " +
                        std::to_string(i + 1));
    }


    std::string
    describe(const FE::SolveReport &solve)
    {
      std::ostringstream text;
      text << "Solved by " << solve.solver;
      if (solve.n_iterations > 0)
        text << ": " << solve.n_iterations << " iterations, condition number "
             << solve.condition_number << ", " << solve.n_patch_dofs
             << " unknowns about the cracks directly";
      return text.str() + '.';
    }


    void
    write_rings(const std::string &file_name, const FE::PlateResults &results)
    {
      std::ostringstream out;
      out.precision(12);
      out << "tip,inner_radius_m,outer_radius_m,K_I_Pa_sqrt_m,K_II_Pa_sqrt_m,"
             "J_J_per_m2\n";
      for (const FE::TipResult &tip : results.tips)
        for (unsigned int i = 0; i < tip.rings.size(); ++i)
          out << tip.tip << ',' << tip.rings[i].inner_radius << ','
              << tip.rings[i].outer_radius << ',' << tip.by_ring[i].mode_I
              << ',' << tip.by_ring[i].mode_II << ',' << tip.energy_release[i]
              << '\n';
      Output::write_atomically(file_name, out.str());
    }
  } // namespace


  bool
  is_fracture_scene(const std::string              &scene_file,
                    const std::vector<std::string> &overrides)
  {
    if (scene_file.empty())
      return false;
    return last_value(read_entries(scene_file, overrides), "Method", "") ==
           "XFEM";
  }


  std::string
  fracture_parameters(const CommandLine &command_line)
  {
    FE::PlateParameters plate;
    ParameterHandler    prm;
    plate.declare(prm);
    set_parameters(
        prm, read_entries(command_line.scene_file, command_line.overrides));
    return command_line.print_parameters == "json" ? parameters_as_json(prm)
           : command_line.print_parameters == "md"
               ? parameters_as_markdown(prm)
               : parameters_as_prm(prm, true);
  }


  void
  run_fracture_scene(const CommandLine &command_line)
  {
    Timer               whole;
    FE::PlateParameters plate;
    ParameterHandler    prm;
    plate.declare(prm);
    set_parameters(
        prm, read_entries(command_line.scene_file, command_line.overrides));
    if (plate.name.empty())
      plate.name =
          std::filesystem::path(command_line.scene_file).stem().string();
    check(plate);
    const auto         cracks       = make_cracks(plate);
    const MPI_Comm     communicator = MPI_COMM_WORLD;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const bool first = Utilities::MPI::this_mpi_process(communicator) == 0;
    if (n_ranks > 1 && plate.solver == "umfpack")
      throw InputError("'XFEM/Solver' is 'umfpack', which works on one rank "
                       "only: choose 'multifrontal' or 'iterative'.");
    const FirstRank first_rank;
    if (command_line.run.validate_only)
      {
        if (first)
          std::cout << "Scene '" << plate.name
                    << "' is sound: " << plate.cells_x * plate.cells_y
                    << " cells of degree " << plate.degree
                    << " before refinement, " << cracks.size() << " crack(s), "
                    << Fracture::collect_tips(cracks).size() << " tip(s).\n";
        return;
      }

    std::unique_ptr<Triangulation<2>> triangulation;
    if (n_ranks > 1)
      triangulation = std::make_unique<parallel::distributed::Triangulation<2>>(
          communicator);
    else
      triangulation = std::make_unique<Triangulation<2>>(
          Triangulation<2>::limit_level_difference_at_vertices);
    FE::PlateProblem        problem(plate, cracks, *triangulation);
    const FE::PlateResults &results = problem.run();
    Output::Summary         summary;
    add_tips(summary, plate, problem, results);
    if (plate.energy_growth > 0. && n_ranks == 1)
      summary.add("stress_intensity_energy",
                  FE::energy_route(plate, results.strain_energy),
                  "Pa sqrt(m)",
                  "sqrt(E' G) from the energy difference T3-47 (all tips "
                  "together; one-sided, biased low by some (da/a)^2)");
    add_costs(summary, results);
    const double computing = whole.wall_time();

    std::string folder = command_line.run.output_directory;
    if (folder.empty())
      folder = "output/" + plate.name;
    first_rank.run([&] { prepare_output_directory(folder); });
    RunLog log(folder + "/run.log", command_line.run.quiet, first);
    log << (plate.title.empty() ? plate.name : plate.title) << '\n'
        << results.n_cells << " cells, " << results.solve.n_dofs
        << " degrees of freedom, " << computing << " s\n"
        << describe(results.solve) << '\n';
    for (const FE::TipResult &tip : results.tips)
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

    first_rank.run([&] { Output::create_folder(folder + "/solution"); });
    const std::string rank =
        n_ranks > 1
            ? "_" +
                  std::to_string(Utilities::MPI::this_mpi_process(communicator))
            : "";
    Output::write_atomically(folder + "/solution/plate" + rank + ".vtu",
                             FE::open_crack_vtu(problem.get_problem(),
                                                problem.get_solution(),
                                                results.tips,
                                                plate.degree > 1 ? 4 : 1));
    Output::write_atomically(folder + "/solution/enriched_nodes" + rank +
                                 ".vtu",
                             FE::enriched_nodes_vtu(problem.get_space()));
    if (!first)
      return;
    write_rings(folder + "/stress_intensity.csv", results);
    const std::string used = parameters_as_prm(prm, false);
    Output::write_atomically(folder + "/used.prm", used);
    summary.add_text("title", plate.title);
    summary.add_text("deal_ii_version", DEAL_II_PACKAGE_VERSION);
    summary.add_text("parameters_hash", text_hash(used));
    summary.add("wall_time", whole.wall_time(), "s", "whole run");
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    summary.add("peak_memory", 1024. * memory.VmHWM, "B", "resident, rank 0");
    summary.write(folder + "/summary.json");
  }
} // namespace Morsel
