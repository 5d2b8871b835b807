#include "xfem_run.h"

#include "plate_summary.h"
#include "xfem_plan.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/log.h>
#include <morsel/core/vtu.h>
#include <morsel/fe/open_crack_output.h>
#include <morsel/fe/point_values.h>
#include <morsel/fracture/plate_output.h>

#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <deal.II/distributed/tria.h>

#include <cctype>
#include <filesystem>
#include <functional>
#include <sstream>

namespace Morsel
{
  using namespace dealii;

  namespace
  {
    /// Several ranks need the distributed mesh.
    std::unique_ptr<Triangulation<2>>
    make_triangulation(const MPI_Comm communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) > 1)
        return std::make_unique<parallel::distributed::Triangulation<2>>(
            communicator);
      return std::make_unique<Triangulation<2>>(
          Triangulation<2>::limit_level_difference_at_vertices);
    }


    void
    add_costs(Output::Summary &summary, const FE::PlateResults &results)
    {
      summary.add(
          "strain_energy", results.strain_energy, "J/m", "per metre of depth");
      summary.add("external_work",
                  results.external_work,
                  "J/m",
                  "load times displacement, twice the strain energy, per metre "
                  "of depth");
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
      else
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
      return text.str();
    }


    /// Removes what a former run on other ranks left: NAME.vtu, NAME_0.vtu,
    /// NAME_1.vtu and so on, which this program alone writes.
    void
    remove_pieces(const std::filesystem::path &folder, const std::string &name)
    {
      std::vector<std::filesystem::path> old;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        {
          const std::string stem = entry.path().stem();
          if (entry.path().extension() != ".vtu" ||
              stem.compare(0, name.size(), name) != 0)
            continue;
          const std::string rest = stem.substr(name.size());
          if (rest.empty() ||
              (rest.size() > 1 && rest[0] == '_' &&
               std::all_of(rest.begin() + 1, rest.end(), [](unsigned char c) {
                 return std::isdigit(c) != 0;
               })))
            old.push_back(entry.path());
        }
      for (const auto &file : old)
        std::filesystem::remove(file);
    }


    /// Writes one file of each rank and the collection that ParaView opens.
    void
    write_pieces(const std::string &folder,
                 const std::string &name,
                 const std::string &text)
    {
      const MPI_Comm     communicator = MPI_COMM_WORLD;
      const unsigned int n_ranks =
          Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
      if (rank == 0)
        remove_pieces(folder, name);
      MPI_Barrier(communicator);
      std::vector<std::string> files;
      for (unsigned int r = 0; r < n_ranks; ++r)
        files.push_back(name + (n_ranks > 1 ? "_" + std::to_string(r) : "") +
                        ".vtu");
      write_atomically(folder + "/" + files[rank], text);
      if (rank == 0)
        write_atomically(folder + "/" + name + ".pvd", pvd_text(files));
    }


    void
    write_fields(const std::string                  &folder,
                 const FE::PlateParameters          &plate,
                 const std::vector<Fracture::Crack> &cracks,
                 const FE::PlateProblem             &problem,
                 const FE::PlateResults             &results)
    {
      const bool first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      const std::string solution = folder + "/solution";
      if (first)
        create_folder(solution);
      MPI_Barrier(MPI_COMM_WORLD);
      write_pieces(solution,
                   "plate",
                   FE::open_crack_vtu(problem.get_problem(),
                                      problem.get_solution(),
                                      results.tips,
                                      plate.degree > 1 ? 4 : 1));
      write_pieces(solution,
                   "enriched_nodes",
                   FE::enriched_nodes_vtu(problem.get_space()));

      // Sampling is collective, the tables are the first rank's.
      const auto sample = [&](const std::vector<Point<2>> &points) {
        return FE::sample_points(
            problem.get_problem(), problem.get_solution(), points);
      };
      const auto       &tips = problem.get_space().get_tips();
      const std::string opening =
          Fracture::crack_opening_csv(plate, cracks, results.tips, sample);
      const std::string stress =
          Fracture::tip_stress_csv(plate, tips, results.tips, sample);
      if (!first)
        return;
      write_atomically(folder + "/crack_opening.csv", opening);
      write_atomically(folder + "/tip_stress.csv", stress);
      write_atomically(folder + "/stress_intensity.csv",
                       Fracture::stress_intensity_csv(tips, results.tips));
      write_atomically(solution + "/rings.vtu",
                       Fracture::rings_vtu(tips, results.tips));
      write_atomically(solution + "/cracks.vtu",
                       Fracture::cracks_vtu(plate, cracks));
    }
  } // namespace


  void
  run_xfem(const FE::PlateParameters &plate,
           const RunOptions          &options,
           const std::string         &used_parameters)
  {
    Timer              whole;
    const MPI_Comm     communicator = MPI_COMM_WORLD;
    const std::string &folder       = options.output_directory;
    const bool first = Utilities::MPI::this_mpi_process(communicator) == 0;
    RunLog     log(folder + "/run.log", options.quiet, first);
    start_log(log, plate, options, used_parameters);

    const auto              cracks        = Fracture::make_cracks(plate);
    const auto              triangulation = make_triangulation(communicator);
    FE::PlateProblem        problem(plate, cracks, *triangulation);
    const FE::PlateResults &results = problem.run();
    std::ostringstream      costs;
    costs << results.n_cells << " cells, " << results.solve.n_dofs
          << " degrees of freedom. " << describe(results.solve);
    finish_run({plate,
                cracks,
                results.tips,
                effects_of(plate, cracks),
                results.solve.solver,
                costs.str(),
                [&] { return FE::energy_route(plate, results.strain_energy); },
                [&](Output::Summary &summary) { add_costs(summary, results); },
                [&] { write_fields(folder, plate, cracks, problem, results); },
                [&](const std::vector<Point<2>> &points) {
                  return FE::sample_points(
                      problem.get_problem(), problem.get_solution(), points);
                }},
               whole,
               log,
               folder,
               used_parameters);
  }
} // namespace Morsel
