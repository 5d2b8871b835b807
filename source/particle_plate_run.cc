#include "particle_plate_run.h"

#include "costs.h"
#include "plate_summary.h"
#include "run_summary.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/command_line.h>
#include <morsel/core/log.h>
#include <morsel/fracture/plate_output.h>
#include <morsel/sph/plate_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace Morsel
{
  using namespace dealii;

  namespace
  {
    std::vector<Output::Effect>
    effects_of(const SPH::PlateParameters         &plate,
               const std::vector<Fracture::Crack> &cracks)
    {
      return {
          {std::string("elastic plate (") +
               (plate.plane_stress ? "plane stress" : "plane strain") + ")",
           true,
           "Material"},
          {plate.gradient + " gradient", true, "SPH/Gradient"},
          {"residual control of zero-energy modes",
           plate.hourglass > 0.,
           "SPH/Hourglass coefficient"},
          {"particles fitted to " + std::to_string(cracks.size()) + " crack(s)",
           !cracks.empty() && plate.fit_to_cracks,
           "SPH/Fit to cracks"},
          {"scattered particles", plate.scatter > 0., "SPH/Scatter"},
          {"cracks by " + plate.tip_handling,
           !cracks.empty(),
           "SPH/Tip handling"}};
    }


    /// The plate by at most about a thousand particles, as many along each side
    /// for one another as before; counts stay even or odd.
    SPH::PlateParameters
    coarsened(SPH::PlateParameters plate)
    {
      const double step =
          std::max(1., std::sqrt(1e-3 * plate.particles_x * plate.particles_y));
      for (unsigned int *n : {&plate.particles_x, &plate.particles_y})
        *n = *n % 2 + 2 * std::lround(0.5 * *n / step);
      plate.energy_growth = 0.;
      return plate;
    }


    /// Times of a solution with the plate's own settings, on which the number
    /// of iterations depends; it hardly depends on the number of particles.
    Times
    trial_solution(const SPH::PlateParameters &plate)
    {
      const Timer  timer;
      const double processor = processor_time();
      unsigned int n         = 0;
      do
        {
          SPH::PlateProblem(plate, Fracture::make_cracks(plate)).run();
          ++n;
      } while (timer.wall_time() < 1. / 3.);
      return {timer.wall_time() / n, (processor_time() - processor) / n};
    }


    void
    add_costs(Output::Summary &summary, const SPH::PlateResults &results)
    {
      const auto add = [&](const char  *name,
                           const double value,
                           const char  *unit,
                           const char  *meaning) {
        summary.add(name, value, unit, meaning);
      };
      const SPH::StaticReport &solve = results.solve;
      add("strain_energy",
          results.strain_energy,
          "J/m",
          "residual control included, per metre of depth");
      add("hourglass_energy",
          results.hourglass_energy,
          "J/m",
          "part of the strain energy in the residual control");
      add("external_work",
          results.external_work,
          "J/m",
          "load times displacement, twice the strain energy, per metre of "
          "depth");
      add("particle_count", results.n_particles, "1", "particles");
      add("neighbours_per_particle",
          results.n_neighbours,
          "1",
          "mean number in the discrete gradient");
      add_static_report(summary, solve);
      add("wall_time_loop",
          results.cloud_time + results.operator_time + solve.setup_time +
              solve.solution_time + results.tip_time,
          "s",
          "cloud, gradient, preconditioner, solution and stress intensity");
      summary.add_part("cloud", results.cloud_time);
      summary.add_part("gradient", results.operator_time);
      summary.add_part("preconditioner", solve.setup_time);
      summary.add_part("solution", solve.solution_time);
      summary.add_part("stress intensity", results.tip_time);
    }


    void
    write_fields(const std::string                  &folder,
                 const SPH::PlateParameters         &plate,
                 const std::vector<Fracture::Crack> &cracks,
                 const SPH::PlateProblem            &problem,
                 const SPH::PlateResults            &results)
    {
      const std::string solution = folder + "/solution/";
      create_folder(solution);
      const auto write = [&](const std::string &name, const std::string &text) {
        write_atomically(name, text);
      };
      const auto sample = [&](const std::vector<Point<2>> &points) {
        return problem.get_field().sample(points);
      };
      const auto &tips = problem.get_tips();
      write(solution + "particles.vtu", SPH::particles_vtu(problem));
      write(solution + "plate.vtu", SPH::cells_vtu(problem));
      write(solution + "rings.vtu", Fracture::rings_vtu(tips, results.tips));
      write(solution + "cracks.vtu", Fracture::cracks_vtu(plate, cracks));
      write(folder + "/stress_intensity.csv",
            Fracture::stress_intensity_csv(tips, results.tips));
      write(folder + "/crack_opening.csv",
            Fracture::crack_opening_csv(plate, cracks, results.tips, sample));
      write(folder + "/tip_stress.csv",
            Fracture::tip_stress_csv(plate, tips, results.tips, sample));
    }
  } // namespace


  Prediction
  predict_particle_plate(const SPH::PlateParameters &plate)
  {
    const auto   cracks = Fracture::make_cracks(plate);
    const double n      = 1. * plate.particles_x * plate.particles_y;
    const Sizes  sizes  = {{"particles", n}};
    const Costs  costs;
    Prediction   prediction;
    prediction.scene    = plate.name;
    prediction.effects  = Output::effects_as_text(effects_of(plate, cracks));
    prediction.unknowns = 2. * n;
    prediction.bytes    = costs.of("particle plate solution", "bytes", sizes);
    const auto seconds  = [&](const char *part, const double particles) {
      return costs.of(part, "seconds", {{"particles", particles}});
    };
    const SPH::PlateParameters coarse = coarsened(plate);
    const double n_coarse = 1. * coarse.particles_x * coarse.particles_y;
    const double repeats  = ((plate.energy_growth > 0. ? 3. : 1.) *
                                seconds("particle plate solution", n) +
                            seconds("particle plate fields", n)) /
                           seconds("particle plate solution", n_coarse);
    const Times start = start_time(), trial = trial_solution(coarse);
    prediction.seconds           = start.wall + repeats * trial.wall;
    prediction.processor_seconds = start.processor + repeats * trial.processor;
    prediction.basis = "recorded costs, tried now with fewer particles";
    prediction.count("Particles", n);
    prediction.count("Cracks", cracks.size());
    prediction.count("Crack tips", Fracture::collect_tips(cracks).size());
    return prediction;
  }


  void
  run_particle_plate(const SPH::PlateParameters &plate,
                     const RunOptions           &options,
                     const std::string          &used_parameters)
  {
    Timer whole;
    // Mistakes that only the particles show come before anything is written.
    const auto         cracks = Fracture::make_cracks(plate);
    SPH::PlateProblem  problem(plate, cracks);
    const std::string &folder = options.output_directory;
    prepare_output_directory(folder);
    RunLog log(folder + "/run.log", options.quiet, true);
    start_log(log, plate, options, used_parameters);

    const SPH::PlateResults &results = problem.run();
    std::ostringstream       costs;
    costs << results.n_particles << " particles, " << results.solve.n_iterations
          << " iterations, residual " << results.solve.residual;
    finish_run(
        {plate,
         cracks,
         results.tips,
         effects_of(plate, cracks),
         "conjugate gradients, preconditioned by a Cholesky factorisation over "
         "Voronoi neighbours",
         costs.str(),
         [&] { return SPH::energy_route(plate, results.strain_energy); },
         [&](Output::Summary &summary) { add_costs(summary, results); },
         [&] { write_fields(folder, plate, cracks, problem, results); },
         [&](const std::vector<Point<2>> &points) {
           return problem.get_field().sample(points);
         }},
        whole,
        log,
        folder,
        used_parameters);
  }
} // namespace Morsel
