#include "static_run.h"

#include "costs.h"
#include "experiment_recorder.h"
#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/core/atomic_file.h>
#include <morsel/core/command_line.h>
#include <morsel/core/errors.h>
#include <morsel/core/expression.h>
#include <morsel/core/log.h>
#include <morsel/core/vtu.h>
#include <morsel/output/summary.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/plate_output.h>
#include <morsel/sph/static_body.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

namespace Morsel
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    using Bodies = std::vector<std::unique_ptr<SPH::StaticBody>>;


    /// Mistakes that only the particles show come before anything is written.
    Bodies
    make_bodies(const Scene::Scene &scene)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        throw InputError("A static solution runs on one rank: start the "
                         "program without mpirun.");
      Bodies bodies;
      for (const Scene::ParticleBody &body : scene.particle_bodies)
        bodies.push_back(std::make_unique<SPH::StaticBody>(scene, body));
      return bodies;
    }


    std::vector<Output::Effect>
    effects_of_equilibrium(const Scene::Scene &scene)
    {
      std::vector<Output::Effect> effects = {
          {"static equilibrium at small strain", true, "Time/Solution"}};
      for (const Scene::ParticleBody &body : scene.particle_bodies)
        {
          const std::string section = "Body " + body.name + "/";
          const auto        add     = [&](const std::string &name,
                               const bool         on,
                               const std::string &entry) {
            effects.push_back({name, on, section + entry});
          };
          add(body.shape.kind + ", " + body.filling + " filling",
              true,
              "Particles/Filling");
          add("scattered particles", body.scatter > 0., "Particles/Scatter");
          add(body.material.plane_stress ? "plane stress" : "plane strain",
              true,
              "Material/Plane stress");
          add("cracks", !body.cracks.paths.empty(), "Cracks/Paths");
          add("residual control of zero-energy modes",
              body.solid.hourglass > 0.,
              "Solid/Hourglass coefficient");
        }
      effects.push_back(
          {"supports and loads", !scene.conditions.empty(), "Conditions"});
      effects.push_back({"fields", scene.output.fields, "Output/Fields"});
      return effects;
    }


    /// Root mean square of the particles' error by volume, over that of what
    /// is expected.
    double
    displacement_error(const SPH::StaticBody &body)
    {
      const VectorExpression known(body.get_body().expected_displacement_field);
      double                 error = 0., size = 0.;
      const SPH::Cloud      &cloud = body.get_cloud();
      for (unsigned int i = 0; i < cloud.size(); ++i)
        {
          const Tensor<1, 2> u = known(cloud.points[i], 0.);
          error += cloud.cells[i].area *
                   (body.get_displacement()[i] - u).norm_square();
          size += cloud.cells[i].area * u.norm_square();
        }
      return std::sqrt(error / size);
    }


    void
    add_body(Output::Summary &summary, const SPH::StaticBody &body)
    {
      const SPH::StaticBodyResults &r = body.get_results();
      const std::string name          = "_" + underscored(body.get_body().name);
      summary.add("cell_area_smallest" + name,
                  r.cells.smallest,
                  "1",
                  "of a particle, over the mean");
      summary.add("cell_area_largest" + name,
                  r.cells.largest,
                  "1",
                  "of a particle, over the mean");
      summary.add("cell_area_deviation" + name,
                  r.cells.deviation,
                  "1",
                  "standard deviation over the mean: how even the filling is");
      summary.add("relaxations" + name,
                  body.get_cloud().n_relaxations,
                  "1",
                  "Lloyd iterations of the filling");
      summary.add("neighbours_per_particle" + name, r.n_neighbours, "1", "");
      if (!body.get_body().expected_displacement_field.empty())
        summary.add("displacement_error" + name,
                    displacement_error(body),
                    "1",
                    "root mean square of the displacement's error over that "
                    "of what is expected");
    }


    void
    add_observers(Output::Summary    &summary,
                  const Scene::Scene &scene,
                  const Bodies       &bodies)
    {
      for (const Scene::Observer &observer : scene.observers)
        for (const auto &body : bodies)
          if (body->get_body().name == observer.body)
            {
              const auto sample = body->observe(observer.point);
              const auto s      = body->get_material().stress(sample.gradient);
              add_observation(summary,
                              observer,
                              {sample.value[0], sample.value[1]},
                              {s[0][0],
                               s[1][1],
                               s[0][1],
                               body->get_material().out_of_plane_stress(s)});
            }
    }


    /// Forces, energies and how converged the solution is, of all bodies.
    void
    add_equilibrium(Output::Summary    &summary,
                    const Scene::Scene &scene,
                    const Bodies       &bodies)
    {
      SPH::EquilibriumResults all;
      for (const auto &body : bodies)
        {
          const SPH::StaticBodyResults &r = body->get_results();
          for (const SPH::ConditionForce &f : r.forces)
            {
              const std::string name =
                  underscored(scene.conditions[f.condition].name);
              summary.add("force_x_" + name, f.force[0], "N", "on the body");
              summary.add("force_y_" + name, f.force[1], "N", "on the body");
            }
          all.strain_energy += scene.depth * r.strain_energy;
          all.hourglass_energy += scene.depth * r.hourglass_energy;
          all.external_work += scene.depth * r.external_work;
          all.n_particles += r.n_particles;
          all.solve.n_dofs += r.solve.n_dofs;
          all.solve.n_iterations += r.solve.n_iterations;
          all.solve.n_multiplier_steps += r.solve.n_multiplier_steps;
          all.solve.residual = std::max(all.solve.residual, r.solve.residual);
          all.solve.support_gap =
              std::max(all.solve.support_gap, r.solve.support_gap);
          all.solve.condition_number =
              std::max(all.solve.condition_number, r.solve.condition_number);
          all.cloud_time += r.cloud_time;
          all.operator_time += r.operator_time;
          all.solve.setup_time += r.solve.setup_time;
          all.solve.solution_time += r.solve.solution_time;
        }
      const auto add = [&](const char  *name,
                           const double value,
                           const char  *unit,
                           const char  *meaning) {
        summary.add(name, value, unit, meaning);
      };
      const double largest =
          std::max(std::abs(all.external_work), all.strain_energy);
      add("strain_energy", all.strain_energy, "J", "residual control included");
      add("hourglass_energy",
          all.hourglass_energy,
          "J",
          "part of the strain energy in the residual control");
      add("external_work",
          all.external_work,
          "J",
          "of loads and prescribed displacements that grow in proportion");
      add("energy_balance_error",
          largest > 0.
              ? std::abs(all.external_work - all.strain_energy) / largest
              : 0.,
          "1",
          "difference of work and strain energy over the larger");
      add_static_report(summary, all.solve);
      add("particle_count", all.n_particles, "1", "");
      add("wall_time_loop",
          all.cloud_time + all.operator_time + all.solve.setup_time +
              all.solve.solution_time,
          "s",
          "filling, gradient, preconditioner and solution");
      summary.add_part("filling", all.cloud_time);
      summary.add_part("gradient", all.operator_time);
      summary.add_part("preconditioner", all.solve.setup_time);
      summary.add_part("solution", all.solve.solution_time);
    }


    /// The loops of a body's boundary as closed lines.
    std::string
    outline_vtu(const Scene::Outline &outline)
    {
      VtuGrid     grid;
      const auto &edges  = outline.get_edges();
      const auto &starts = outline.loop_starts();
      for (unsigned int l = 0; l + 1 < starts.size(); ++l)
        {
          for (unsigned int k = starts[l]; k < starts[l + 1]; ++k)
            grid.add_point(edges[k].first[0], edges[k].first[1]);
          const Point<2> &end = edges[starts[l]].first;
          grid.add_point(end[0], end[1]);
          grid.add_cell(VtuGrid::Shape::poly_line,
                        starts[l + 1] - starts[l] + 1);
        }
      return grid.text();
    }


    void
    write_fields(const std::string &folder, const Bodies &bodies)
    {
      const std::string solution = folder + "/solution/";
      create_folder(solution);
      for (const auto &body : bodies)
        {
          const std::string name =
              solution + underscored(body->get_body().name);
          write_atomically(name + "_particles.vtu", SPH::particles_vtu(*body));
          write_atomically(name + "_cells.vtu", SPH::cells_vtu(*body));
          write_atomically(name + "_outline.vtu",
                           outline_vtu(body->get_body().shape.outline()));
        }
    }
  } // namespace


  void
  run_static(const Scene::Scene &scene, const RunOptions &options)
  {
    const dealii::Timer whole;
    const Bodies        bodies = make_bodies(scene);
    prepare_output_directory(options.output_directory);
    RunLog log(options.output_directory + "/run.log", options.quiet, true);
    write_atomically(options.output_directory + "/used.prm",
                     scene.used_parameters);
    log << scene.title << '\n';
    for (const std::string &advice : scene.warnings)
      log.warning(advice);
    log << Output::effects_as_text(effects_of_equilibrium(scene));

    Output::Summary summary;
    for (const auto &body : bodies)
      {
        const SPH::StaticBodyResults &r = body->run();
        std::ostringstream            text;
        text << "Body '" << body->get_body().name << "': " << r.n_particles
             << " particles, cells even to " << 100. * r.cells.deviation
             << " % after " << body->get_cloud().n_relaxations
             << " relaxations; " << r.solve.n_iterations
             << " iterations, residual " << r.solve.residual << ", support gap "
             << r.solve.support_gap << '\n';
        if (r.n_free_motions > 0)
          text << r.n_free_motions
               << " rigid motion(s) that nothing holds are pinned; the loads "
                  "are in balance.\n";
        log << text.str();
        add_body(summary, *body);
        add_tips_of_body(summary,
                         log,
                         body->get_body(),
                         r.tips,
                         tip_suffixes(SPH::cracks_of(body->get_body()),
                                      body->get_body(),
                                      bodies.size() > 1));
      }
    add_observers(summary, scene, bodies);
    add_equilibrium(summary, scene, bodies);
    if (scene.output.fields)
      {
        const dealii::Timer output;
        write_fields(options.output_directory, bodies);
        summary.add_part("output", output.wall_time());
      }
    summary.add("wall_time", whole.wall_time(), "s", "whole run");
    summary.add_text("kind", "static equilibrium");
    add_provenance(
        summary, scene.title, scene.name, scene.parameters_hash, MPI_COMM_SELF);
    for (const Output::Effect &effect : effects_of_equilibrium(scene))
      summary.add_effect(effect);
    summary.write(options.output_directory + "/summary.json");
  }


  Prediction
  predict_static(const Scene::Scene &scene)
  {
    Prediction prediction;
    prediction.scene   = scene.name;
    prediction.effects = Output::effects_as_text(effects_of_equilibrium(scene));
    prediction.advice  = scene.warnings;
    const Costs costs;
    double      n = 0., seconds = 0.;
    for (const auto &body : make_bodies(scene))
      {
        const double particles = body->get_results().n_particles;
        const Sizes  sizes     = {
                 {"particles", particles},
                 {"relaxations", 1. * body->get_cloud().n_relaxations}};
        n += particles;
        seconds += costs.of("particle body solution", "seconds", sizes);
        if (scene.output.fields)
          seconds += costs.of("particle body fields", "seconds", sizes);
      }
    costs.predict_time(prediction, Workload::static_particles, seconds);
    prediction.unknowns = 2. * n;
    prediction.bytes =
        costs.of("particle body solution", "bytes", {{"particles", n}});
    prediction.count("Particles", n);
    return prediction;
  }
} // namespace Morsel
