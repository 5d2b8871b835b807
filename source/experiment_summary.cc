#include "experiment_recorder.h"
#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/core/kernel.h>
#include <morsel/core/number_list.h>
#include <morsel/measure/particle_field.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace Morsel
{
  namespace
  {
    /// Mean and noise of the stress where supports are full.
    void
    add_interior(const Scene::ParticleBody &body,
                 const SPH::DeformableBody &solid,
                 const std::string         &name,
                 Output::Summary           &summary)
    {
      const Kernel kernel(kernel_named(body.solid.kernel),
                          body.solid.smoothing_ratio * body.spacing);
      const auto   s = Measure::interior_stress(solid, body, kernel.support());
      if (s.count == 0)
        return;
      const std::string meaning =
          "over the particles with a full support, at the end";
      summary.add("stress_mean_xx" + name, s.mean_xx, "Pa", "mean " + meaning);
      summary.add("stress_mean_yy" + name, s.mean_yy, "Pa", "mean " + meaning);
      summary.add("stress_deviation_xx" + name,
                  s.deviation_xx,
                  "Pa",
                  "standard deviation " + meaning);
      summary.add("stress_deviation_yy" + name,
                  s.deviation_yy,
                  "Pa",
                  "standard deviation " + meaning);
    }
  } // namespace


  void
  ExperimentRecorder::summarise_velocity_gradients()
  {
    for (unsigned int b = 0; b < scene.particle_bodies.size(); ++b)
      {
        const auto &body = scene.particle_bodies[b];
        const auto  g    = number_list(body.expected_velocity_gradient, 4);
        if (g.empty())
          continue;
        const Kernel kernel(kernel_named(body.solid.kernel),
                            body.solid.smoothing_ratio * body.spacing);
        const auto   errors =
            Measure::strain_rate_errors(*experiment.bodies()[b],
                                        body,
                                        kernel.support(),
                                        {g[0], g[1], g[2], g[3]});
        const std::string name =
            "strain_rate_error_%_" + underscored(body.name);
        const auto add = [&](const std::string &where,
                             const double       value,
                             const std::string &meaning) {
          std::string text = name;
          text.replace(text.find('%'), 1, where);
          summary.add(text,
                      value,
                      "1/s",
                      "largest error of a strain rate at time 0 " + meaning);
        };
        add("interior", errors.interior, "where the support is full");
        add("edge", errors.edge, "in the outermost rows, off the corners");
        add("corner", errors.corner, "in the corners");
      }
  }


  void
  add_observation(Output::Summary                    &summary,
                  const Scene::Observer              &observer,
                  const Vector2                      &u,
                  const Materials::PlaneStrainStress &s)
  {
    const std::string name    = "_" + underscored(observer.name);
    const auto        known_u = number_list(observer.expected_displacement, 2);
    const auto        known_s = number_list(observer.expected_stress, 3);
    const auto        add     = [&](const std::string         &what,
                         const double               value,
                         const std::string         &unit,
                         const std::vector<double> &known,
                         const unsigned int         component) {
      // Relative to the largest component, since another one may be zero.
      std::optional<double> reference, error;
      if (!known.empty())
        {
          double scale = 0.;
          for (const double x : known)
            scale = std::max(scale, std::abs(x));
          reference = known[component];
          error     = (value - known[component]) / scale;
        }
      summary.add(what + name, value, unit, "at the end", reference, error);
    };
    add("displacement_x", u.x, "m", known_u, 0);
    add("displacement_y", u.y, "m", known_u, 1);
    add("stress_xx", s.xx, "Pa", known_s, 0);
    add("stress_yy", s.yy, "Pa", known_s, 1);
    add("stress_xy", s.xy, "Pa", known_s, 2);
  }


  void
  ExperimentRecorder::summarise_observers()
  {
    for (unsigned int k = 0; k < observed.size(); ++k)
      {
        const Scene::Observer &o    = scene.observers[k];
        const std::string      name = "_" + underscored(o.name);
        add_observation(summary,
                        o,
                        observed[k].probe.displacement(),
                        observed[k].probe.stress());
        if (o.frequency == "none")
          continue;
        summary.add("frequency" + name,
                    observed[k].passages.frequency(),
                    "1/s",
                    "of the displacement along " + o.frequency +
                        ", by its passages through zero",
                    o.expected_frequency > 0.
                        ? std::optional<double>(o.expected_frequency)
                        : std::nullopt);
        summary.add("periods" + name, observed[k].passages.periods(), "1", "");
      }
  }


  void
  ExperimentRecorder::summarise_cracks()
  {
    for (const Gauged &g : gauged)
      add_tips_of_body(
          summary, log, scene.particle_bodies[g.body], g.tips, g.suffixes);
  }


  void
  ExperimentRecorder::summarise_roughness(const unsigned int body,
                                          const std::string &name)
  {
    summary.add("velocity_roughness" + name,
                roughness.back()[body],
                "m/s",
                "root mean square of a particle's difference from the mean "
                "velocity of its four neighbours, at the end");
    unsigned int middle = 0;
    while (sample_times[middle] < 0.5 * sample_times.back())
      ++middle;
    const double first = roughness[middle][body];
    if (first > 0. && roughness.back()[body] > 0. &&
        middle + 1 < sample_times.size())
      summary.add("velocity_roughness_growth" + name,
                  std::log(roughness.back()[body] / first) /
                      (sample_times.back() - sample_times[middle]),
                  "1/s",
                  "exponential rate at which it grew over the second half of "
                  "the run");
  }


  void
  ExperimentRecorder::summarise_bodies()
  {
    for (unsigned int b = 0; b < scene.particle_bodies.size(); ++b)
      {
        const auto       &body = scene.particle_bodies[b];
        const std::string name = "_" + underscored(body.name);
        // These know neighbours by their place in the lattice.
        if (body.is_even_lattice())
          {
            const auto noise =
                Measure::stress_noise(*experiment.bodies()[b], body);
            const std::string meaning =
                "root mean square of a particle's difference from the mean of "
                "its four neighbours over that of the stress, at the end";
            summary.add("stress_noise_xx" + name, noise.xx, "1", meaning);
            summary.add("stress_noise_yy" + name, noise.yy, "1", meaning);
            summarise_roughness(b, name);
          }
        if (body.is_plain_lattice())
          add_interior(body, *experiment.bodies()[b], name, summary);
        summary.add("neighbours_per_particle" + name,
                    experiment.bodies()[b]->neighbours_per_particle(),
                    "1",
                    "");
      }
    summary.add("minimum_spacing",
                least_spacing,
                "1",
                "smallest distance of two particles of a body at any sample, "
                "in spacings; 2: that or more");
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      {
        const Vector2     f    = experiment.force(k);
        const std::string name = underscored(scene.conditions[k].name);
        summary.add("force_x_" + name, f.x, "N", "on the body, at the end");
        summary.add("force_y_" + name, f.y, "N", "on the body, at the end");
      }
    summary.add_text("ended_by",
                     least_spacing < scene.stop.minimum_spacing
                         ? "minimum spacing"
                     : breaking.broken() ? "complete failure"
                                         : "end time");
  }


  void
  ExperimentRecorder::summarise_ledgers()
  {
    const auto &e   = energy.last();
    const auto  add = [&](const std::string &name,
                         const double       value,
                         const std::string &meaning) {
      summary.add(name, value, "J", meaning);
    };
    add("strain_energy", e.strain, "recoverable, at the end");
    add("hourglass_energy", e.hourglass, "in the residual of the linear fit");
    add("kinetic_energy", e.kinetic, "at the end");
    add("external_work", e.external_work, "of supports and loads");
    add("dissipated_energy", e.dissipated(), "");
    add("viscous_energy", e.dissipated_viscosity, "artificial viscosity");
    add("damping_energy", e.dissipated_damping, "by conditions of damping");
    add("artificial_stress_energy",
        e.dissipated_artificial_stress,
        "taken by the artificial stress, may be negative");
    summary.add("energy_balance_error",
                energy.error_at_end(),
                "1",
                "closing error of the energy ledger over its largest term, "
                "at the end");
    summary.add("energy_balance_error_largest",
                energy.largest_error(),
                "1",
                "the same at its worst");
    summary.add(
        "momentum_error",
        momentum.largest_error(),
        "1",
        "change of linear momentum that supports and loads do not "
        "explain over the largest sum of masses times speeds or impulse");
  }


  void
  ExperimentRecorder::summarise_run()
  {
    add_loop_costs(summary,
                   {static_cast<double>(experiment.particle_count()),
                    experiment.step(),
                    experiment.time_step(),
                    experiment.time(),
                    log.wall_time(),
                    log.loop_wall_time()});
    rank_load.summarise(summary, log, 0.);
    add_provenance(
        summary, scene.title, scene.name, scene.parameters_hash, communicator);
    add_effects(summary, effects_of_experiment(scene), log);
  }


  std::vector<Output::Effect>
  effects_of_experiment(const Scene::Scene &scene)
  {
    // Bodies that are worked on together share the time of a part.
    const bool                  alone  = scene.particle_bodies.size() == 1;
    const char *const           bonded = "strain and forces";
    std::vector<Output::Effect> effects;
    for (const auto &body : scene.particle_bodies)
      {
        const auto       &s       = body.solid;
        const std::string section = "Body " + body.name + "/Solid/";
        effects.push_back({s.formulation + " solid, normalisation " +
                               body.normalisation() + ", " + s.kernel,
                           true,
                           section + "Formulation",
                           bonded,
                           alone});
        effects.push_back({"cracks",
                           !body.cracks.paths.empty(),
                           "Body " + body.name + "/Cracks/Paths",
                           bonded});
        effects.push_back({"hourglass control",
                           !s.is_updated() && s.hourglass > 0.,
                           section + "Hourglass coefficient",
                           bonded});
        effects.push_back({"artificial viscosity",
                           s.viscosity == "on" ||
                               (s.viscosity == "auto" && body.damage.enabled),
                           section + "Viscosity",
                           bonded});
        effects.push_back({"artificial stress",
                           s.artificial_stress > 0.,
                           section + "Artificial stress",
                           bonded});
        effects.push_back({"damage",
                           body.damage.enabled,
                           "Body " + body.name + "/Damage/Enabled",
                           "damage and broken bonds",
                           alone});
        effects.push_back(effect_of_grains(body));
      }
    effects.push_back({"supports and loads",
                       !scene.conditions.empty(),
                       "Conditions",
                       "supports and loads",
                       true});
    effects.push_back(
        {"fields", scene.output.fields, "Output/Fields", "output", true});
    return effects;
  }
} // namespace Morsel
