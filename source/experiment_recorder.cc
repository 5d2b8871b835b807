#include "experiment_recorder.h"
#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/core/errors.h>
#include <morsel/measure/particle_field.h>
#include <morsel/sph/body_cracks.h>

#include <algorithm>
#include <cmath>

namespace Morsel
{
  namespace
  {
    std::vector<std::string>
    history_columns(const Scene::Scene             &scene,
                    const std::vector<std::string> &tips,
                    const std::vector<std::string> &breaking)
    {
      std::vector<std::string> c = {"time [s]", "step [1]"};
      for (const auto &observer : scene.observers)
        for (const char *column : {"displacement_x_% [m]",
                                   "displacement_y_% [m]",
                                   "velocity_x_% [m/s]",
                                   "velocity_y_% [m/s]",
                                   "stress_xx_% [Pa]",
                                   "stress_yy_% [Pa]",
                                   "stress_xy_% [Pa]"})
          {
            std::string text = column;
            text.replace(text.find('%'), 1, underscored(observer.name));
            c.push_back(text);
          }
      for (const auto &condition : scene.conditions)
        for (const char d : {'x', 'y'})
          c.push_back(std::string("force_") + d + "_" +
                      underscored(condition.name) + " [N]");
      for (const std::string &tip : tips)
        for (const char *mode : {"I", "II"})
          c.push_back(std::string("stress_intensity_") + mode + tip +
                      " [Pa sqrt(m)]");
      c.insert(c.end(), breaking.begin(), breaking.end());
      c.insert(c.end(),
               {"strain_energy [J]",
                "hourglass_energy [J]",
                "kinetic_energy [J]",
                "external_work [J]",
                "dissipated_viscosity [J]",
                "dissipated_damping [J]",
                "dissipated_artificial_stress [J]",
                "energy_error [1]",
                "momentum_error [1]",
                "minimum_spacing [1]"});
      return c;
    }
  } // namespace


  ExperimentRecorder::ExperimentRecorder(const Scene::Scene &scene,
                                         const RunOptions   &options,
                                         const Experiment   &experiment,
                                         RunLog             &log,
                                         const MPI_Comm      communicator)
      : scene(scene)
      , options(options)
      , experiment(experiment)
      , log(log)
      , communicator(communicator)
      , breaking(scene, experiment)
      , energy(experiment.energies())
      , momentum(experiment.momentum(), experiment.masses_times_speeds())
      , rank_load(communicator)
  {
    log.begin_loop();
    for (const auto &observer : scene.observers)
      {
        const unsigned int body = experiment.index_of(observer.body);
        observed.push_back(
            {body,
             Measure::Probe(*experiment.bodies()[body], observer.point),
             {}});
      }
    open_gauges();
    std::vector<std::string> tips;
    for (const Gauged &g : gauged)
      tips.insert(tips.end(), g.suffixes.begin(), g.suffixes.end());
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      history = std::make_unique<Output::History>(
          options.output_directory + "/history.csv",
          history_columns(scene, tips, breaking.columns()));
    if (scene.output.fields)
      for (const auto &body : scene.particle_bodies)
        frames.push_back(std::make_unique<Output::Frames<0>>(
            options.output_directory + "/solution",
            underscored(body.name),
            communicator));
    summarise_velocity_gradients();
  }


  void
  ExperimentRecorder::open_gauges()
  {
    for (unsigned int b = 0; b < scene.particle_bodies.size(); ++b)
      {
        const Scene::ParticleBody &body = scene.particle_bodies[b];
        if (body.cracks.paths.empty())
          continue;
        gauged.push_back({b,
                          std::make_unique<Measure::CrackGauge>(
                              body, *experiment.bodies()[b], scene.seed),
                          tip_suffixes(SPH::cracks_of(body),
                                       body,
                                       scene.particle_bodies.size() > 1),
                          {}});
      }
  }


  bool
  ExperimentRecorder::samples_now() const
  {
    return experiment.time() >= next_sample - 1e-9 * scene.time.end_time;
  }


  bool
  ExperimentRecorder::frame_is_due() const
  {
    return !frames.empty() &&
           experiment.time() >= next_frame - 1e-9 * scene.time.end_time;
  }


  bool
  ExperimentRecorder::records_now() const
  {
    return samples_now() || frame_is_due();
  }


  double
  ExperimentRecorder::progress() const
  {
    return std::min(1., experiment.time() / scene.time.end_time);
  }


  void
  ExperimentRecorder::follow()
  {
    for (unsigned int k = 0; k < observed.size(); ++k)
      if (scene.observers[k].frequency != "none")
        {
          Observed     &o = observed[k];
          const Vector2 u = o.probe.displacement();
          o.passages.add(experiment.time(),
                         scene.observers[k].frequency == "x" ? u.x : u.y);
        }
    if (breaking.active())
      breaking.follow();
    if (samples_now())
      {
        sample();
        next_sample += scene.time.end_time / scene.output.history_samples;
      }
    if (frame_is_due())
      {
        write_frame();
        next_frame +=
            scene.time.end_time / std::max(1u, scene.output.field_frames);
      }
  }


  bool
  ExperimentRecorder::finished() const
  {
    return experiment.time() >= scene.time.end_time * (1. - 1e-9) ||
           least_spacing < scene.stop.minimum_spacing || breaking.broken();
  }


  void
  ExperimentRecorder::sample()
  {
    const auto timer                     = log.section("measures");
    last_sample_time                     = experiment.time();
    const Measure::Energies e            = experiment.energies();
    const double            energy_error = energy.record(e, 0.);
    const double            momentum_error =
        momentum.record(experiment.momentum(),
                        experiment.masses_times_speeds(),
                        experiment.impulses());
    breaking.note(e);
    double spacing = 2.;
    for (const auto &body : experiment.bodies())
      spacing = std::min(spacing, Measure::smallest_spacing(*body));
    least_spacing = std::min(least_spacing, spacing);
    sample_times.push_back(experiment.time());
    roughness.emplace_back();
    for (unsigned int b = 0; b < scene.particle_bodies.size(); ++b)
      roughness.back().push_back(
          scene.particle_bodies[b].is_even_lattice()
              ? Measure::velocity_roughness(*experiment.bodies()[b],
                                            scene.particle_bodies[b])
              : 0.);

    std::vector<double> row = {experiment.time(),
                               static_cast<double>(experiment.step())};
    for (const Observed &o : observed)
      {
        const Vector2 u = o.probe.displacement();
        const Vector2 v = o.probe.velocity();
        const auto    s = o.probe.stress();
        row.insert(row.end(), {u.x, u.y, v.x, v.y, s.xx, s.yy, s.xy});
      }
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      {
        const Vector2 f = experiment.force(k);
        row.insert(row.end(), {f.x, f.y});
      }
    for (Gauged &g : gauged)
      {
        // Once it grows, the crack is no longer the one that is gauged.
        if (g.tips.empty() || !breaking.has_failed(g.body))
          g.tips = g.gauge->evaluate();
        for (const Fracture::TipResult &tip : g.tips)
          row.insert(row.end(),
                     {tip.statistics.mean.mode_I, tip.statistics.mean.mode_II});
      }
    const std::vector<double> broken = breaking.row();
    row.insert(row.end(), broken.begin(), broken.end());
    row.insert(row.end(),
               {e.strain,
                e.hourglass,
                e.kinetic,
                e.external_work,
                e.dissipated_viscosity,
                e.dissipated_damping,
                e.dissipated_artificial_stress,
                energy_error,
                momentum_error,
                spacing});
    if (history)
      history->add_row(row);
    rank_load.sample(experiment.time());
  }


  void
  ExperimentRecorder::write_frame()
  {
    using Field      = Output::Field;
    const auto timer = log.section("output");
    last_frame_time  = experiment.time();
    for (unsigned int b = 0; b < frames.size(); ++b)
      {
        const auto                   &body = *experiment.bodies()[b];
        const auto                   &p    = body.get_particles();
        const unsigned int            n    = p.n_owned;
        std::vector<dealii::Point<2>> points(n);
        std::vector<double> u, v, density(n), mises(n), xx(n), yy(n), xy(n),
            failed, fragment;
        for (unsigned int i = 0; i < n; ++i)
          {
            const Motion &m = p.motion[i];
            const auto    s = body.stress(i);
            points[i]       = p.position(i);
            u.insert(u.end(), {m.u_x, m.u_y});
            v.insert(v.end(), {m.v_x, m.v_y});
            density[i] = body.density_ratio(i) *
                         scene.particle_bodies[b].material.density;
            mises[i] = Materials::von_mises(s);
            xx[i]    = s.xx;
            yy[i]    = s.yy;
            xy[i]    = s.xy;
          }
        std::vector<Field> fields = {{"displacement", Field::Kind::vector, u},
                                     {"velocity", Field::Kind::vector, v},
                                     {"density", Field::Kind::scalar, density},
                                     {"von_mises", Field::Kind::scalar, mises},
                                     {"stress_xx", Field::Kind::scalar, xx},
                                     {"stress_yy", Field::Kind::scalar, yy},
                                     {"stress_xy", Field::Kind::scalar, xy}};
        if (!p.damage.empty())
          {
            failed.assign(p.failed.begin(), p.failed.begin() + n);
            fields.push_back(
                {"damage",
                 Field::Kind::scalar,
                 dealii::ArrayView<const double>(p.damage.data(), n)});
            fields.push_back({"failed", Field::Kind::scalar, failed});
            const auto labels = breaking.labels(b);
            fragment.assign(labels.begin(), labels.end());
            fields.push_back({"fragment", Field::Kind::scalar, fragment});
          }
        const std::vector<double> modulus = body.youngs_moduli();
        if (!modulus.empty())
          fields.push_back({"youngs_modulus", Field::Kind::scalar, modulus});
        frames[b]->write(experiment.time(), points, fields);
      }
  }


  void
  ExperimentRecorder::finish(const LoopReport &report)
  {
    if (last_sample_time < experiment.time())
      sample();
    log.end_progress();
    if (!frames.empty() && last_frame_time < experiment.time())
      write_frame();
    for (auto &body : frames)
      body->finish();
    summarise_observers();
    summarise_cracks();
    summarise_bodies();
    breaking.summarise(summary);
    summarise_ledgers();
    summarise_run();
    add_loop_report(summary, report);
    if (history)
      summary.write(options.output_directory + "/summary.json");
  }
} // namespace Morsel
