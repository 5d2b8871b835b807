#include "recorder.h"
#include "breaking_recorder.h"
#include "run_summary.h"

#include <morsel/core/errors.h>
#include <morsel/scene/complete.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Morsel
{
  namespace
  {
    Measure::StrokeSettings
    stroke_settings(const Scene::Scene &scene, const unsigned int axis)
    {
      const auto             &body = scene.particle_bodies.front();
      Measure::StrokeSettings s;
      s.loaded_area           = body.shape.extent(1 - axis) * scene.depth;
      s.height                = body.shape.extent(axis);
      s.residual_force        = scene.stop.residual_force;
      s.closure_after_failure = scene.stop.closure_after_failure;
      if (body.damage.enabled)
        {
          // What is no block, or no block between flat plates, may split at a
          // small share of the nominal stress that its material bears.
          const bool block = body.shape.is_rectangle() &&
                             std::none_of(scene.plate_bodies.begin(),
                                          scene.plate_bodies.end(),
                                          [](const Scene::PlateBody &plate) {
                                            return plate.shape.is_mesh();
                                          });
          if (block)
            s.prescribed_strength = body.material.compressive_strength;
          s.minimum_peak =
              (block ? 0.2 : 0.02) * body.material.compressive_strength;
        }
      return s;
    }


    bool
    any_elastic(const Scene::Scene &scene)
    {
      return std::any_of(scene.plate_bodies.begin(),
                         scene.plate_bodies.end(),
                         [](const Scene::PlateBody &body) {
                           return body.deformation.elastic;
                         });
    }


    std::vector<std::string>
    history_columns(const Scene::Scene &scene, const DriveRecord &drives)
    {
      std::vector<std::string> c = {"time [s]",
                                    "step [1]",
                                    "closure [m]",
                                    "nominal_strain [1]",
                                    "nominal_stress [Pa]"};
      for (const auto &plate : scene.plate_bodies)
        c.push_back("force_" + underscored(plate.name) + " [N]");
      for (const auto &plate : scene.plate_bodies)
        c.push_back("tangential_force_" + underscored(plate.name) + " [N]");
      for (const char *name : {"strain_energy",
                               "hourglass_energy",
                               "kinetic_energy",
                               "contact_energy",
                               "granular_energy",
                               "external_work",
                               "dissipated_viscosity",
                               "dissipated_damage",
                               "dissipated_bonds",
                               "dissipated_friction",
                               "dissipated_granular_friction"})
        c.push_back(std::string(name) + " [J]");
      if (any_elastic(scene))
        c.insert(c.end(),
                 {"plate_strain_energy [J]", "plate_kinetic_energy [J]"});
      const auto of_drives = drives.columns();
      c.insert(c.end(), of_drives.begin(), of_drives.end());
      c.insert(c.end(),
               {"energy_error [1]",
                "momentum_error [1]",
                "failed_share [1]",
                "time_step [s]"});
      return c;
    }


    /// Speed at which the plates close, once they have reached it [m/s].
    double
    closing_speed(const Scene::Scene &scene, const unsigned int axis)
    {
      double speed = 0.;
      for (const auto &plate : scene.plate_bodies)
        speed += std::abs(plate.motion.typical_velocity()[axis]);
      return speed;
    }


    /// The first moments are the interesting ones: the way to failure and as
    /// long again get most of the samples.
    double
    interesting_time(const Scene::Scene &scene, const unsigned int axis)
    {
      const double speed  = closing_speed(scene, axis);
      double       behind = 0.;
      for (const auto &plate : scene.plate_bodies)
        behind += std::abs(plate.motion.typical_velocity()[axis]) *
                  plate.motion.delay();
      return speed > 0.
                 ? std::min(
                       scene.time.end_time,
                       2. * (expected_failure_closure(scene, axis) + behind) /
                           speed)
                 : scene.time.end_time;
    }
  } // namespace


  Cadence::Cadence(const unsigned int budget, const double interval)
      : budget(std::max(2u, budget))
      , interval(interval)
      , limit(0.5 * this->budget)
  {}


  bool
  Cadence::due(const double time)
  {
    if (!is_due(time))
      return false;
    if (++spent >= limit)
      {
        interval *= 2.;
        limit += std::max(1., 0.5 * (budget - limit));
      }
    next = time + interval;
    return true;
  }


  double
  expected_failure_closure(const Scene::Scene &scene, const unsigned int axis)
  {
    const auto &body = scene.particle_bodies.front();
    return body.damage.enabled
               ? Scene::expected_failure_closure(body, axis)
               : scene.stop.maximum_closure * body.shape.extent(axis);
  }


  Recorder::Recorder(const Scene::Scene &scene,
                     const RunOptions   &options,
                     const Bite         &bite,
                     RunLog             &log,
                     const MPI_Comm      communicator)
      : scene(scene)
      , options(options)
      , bite(bite)
      , log(log)
      , communicator(communicator)
      , first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      , stroke(stroke_settings(scene, bite.closing_axis()))
      , energy(bite.energies())
      , momentum(bite.momentum(), bite.masses_times_speeds())
      , drives(bite)
      , history_due(scene.output.history_samples,
                    2. * interesting_time(scene, bite.closing_axis()) /
                        scene.output.history_samples)
      , frame_due(scene.output.field_frames,
                  2. * interesting_time(scene, bite.closing_axis()) /
                      std::max(1u, scene.output.field_frames))
      , tooth_cracks(bite, log)
      , rank_load(communicator)
  {
    log.begin_loop();
    auto       columns = history_columns(scene, drives);
    const auto more    = tooth_cracks.columns();
    columns.insert(columns.end(), more.begin(), more.end());
    if (first_rank)
      history = std::make_unique<Output::History>(
          options.output_directory + "/history.csv", columns);
    if (scene.output.fields)
      {
        const std::string folder = options.output_directory + "/solution";
        particle_frames =
            std::make_unique<Output::Frames<0>>(folder, "food", communicator);
        if (!bite.get_plates().empty())
          {
            plate_frames = std::make_unique<Output::Frames<2>>(
                folder, "plates", communicator);
            surface_frames = std::make_unique<Output::Frames<1>>(
                folder, "surfaces", communicator);
          }
        for (const auto &plate : bite.get_plates())
          if (plate.get_deformation() && !elastic_frames)
            elastic_frames = std::make_unique<Output::Frames<2>>(
                folder, "elastic_plates", communicator);
      }
    find_fragments();
    intact = fragments;
    if (bite.food().can_fail())
      breakage = std::make_unique<Measure::Breakage>(
          bite.food(), tip_places(scene.particle_bodies.front()));
  }


  bool
  Recorder::samples_now() const
  {
    return history_due.is_due(bite.time());
  }


  bool
  Recorder::records_now() const
  {
    return samples_now() ||
           (scene.output.fields && frame_due.is_due(bite.time()));
  }


  void
  Recorder::follow()
  {
    Measure::StrokeSample s;
    s.time           = bite.time();
    s.closure        = bite.closure();
    s.strain_energy  = last_strain;
    s.kinetic_energy = last_kinetic;
    for (unsigned int p = 0; p < bite.get_plates().size(); ++p)
      {
        s.normal_force.push_back(bite.normal_force(p));
        s.tangential_force.push_back(bite.tangential_force(p));
      }
    stroke.add(s);
    follow_surfaces();
    drives.follow(stroke.mean_force());
    if (breakage)
      breakage->follow(bite.time());
    if (const auto time = stroke.time_of_half_force();
        time && *time == bite.time())
      pattern_at_half = find_pattern();

    if (history_due.due(bite.time()))
      sample();
    if (scene.output.fields && frame_due.due(bite.time()))
      write_frame();
  }


  void
  Recorder::sample()
  {
    const auto              timer = log.section("measures");
    const Measure::Energies e     = bite.energies();
    last_strain                   = e.strain;
    last_kinetic                  = e.kinetic;
    const double error            = energy.record(e, stroke.mean_force());
    const double momentum_error   = momentum.record(
        bite.momentum(), bite.masses_times_speeds(), bite.impulses());
    deepest          = std::max(deepest, bite.deepest_penetration());
    most_inverted    = std::max(most_inverted, bite.food().inverted_count());
    last_sample_time = bite.time();
    follow_deflections();

    // Collective: on all ranks, not only on the one that writes.
    std::vector<double> forces;
    for (unsigned int p = 0; p < bite.get_plates().size(); ++p)
      forces.push_back(bite.normal_force(p));
    for (unsigned int p = 0; p < bite.get_plates().size(); ++p)
      forces.push_back(bite.tangential_force(p));
    const auto crack_values = tooth_cracks.follow(forces);

    const auto of_drives = drives.row();
    if (history)
      {
        std::vector<double> row = {bite.time(),
                                   static_cast<double>(bite.step()),
                                   bite.closure(),
                                   stroke.nominal_strain(),
                                   stroke.nominal_stress()};
        row.insert(row.end(), forces.begin(), forces.end());
        row.insert(row.end(),
                   {e.strain,
                    e.hourglass,
                    e.kinetic,
                    e.contact,
                    e.granular,
                    e.external_work,
                    e.dissipated_viscosity,
                    e.dissipated_damage,
                    e.dissipated_bonds,
                    e.dissipated_friction,
                    e.dissipated_granular_friction});
        if (any_elastic(scene))
          row.insert(row.end(), {e.plate_strain, e.plate_kinetic});
        row.insert(row.end(), of_drives.begin(), of_drives.end());
        row.insert(row.end(),
                   {error,
                    momentum_error,
                    bite.food().failed_share(),
                    bite.time_step()});
        row.insert(row.end(), crack_values.begin(), crack_values.end());
        history->add_row(row);
      }
    rank_load.sample(bite.time());
  }


  StopReason
  Recorder::stop_reason() const
  {
    if (scene.particle_bodies.front().damage.enabled &&
        stroke.failed_completely())
      return StopReason::complete_failure;
    if (bite.closure() >=
        scene.stop.maximum_closure *
            scene.particle_bodies.front().shape.extent(bite.closing_axis()))
      return StopReason::maximum_closure;
    if (bite.time() >= scene.time.end_time * (1. - 1e-9))
      return StopReason::end_time;
    return StopReason::none;
  }


  double
  Recorder::progress() const
  {
    const double height =
        scene.particle_bodies.front().shape.extent(bite.closing_axis());
    const double expected =
        scene.particle_bodies.front().damage.enabled
            ? 1.5 * expected_failure_closure(scene, bite.closing_axis()) +
                  scene.stop.closure_after_failure * height
            : scene.stop.maximum_closure * height;
    return std::min(
        1.,
        std::max(bite.time() / scene.time.end_time,
                 bite.closure() /
                     std::min(expected, scene.stop.maximum_closure * height)));
  }


  void
  Recorder::find_fragments()
  {
    fragments =
        Measure::fragments_of(bite.food(), scene.measures.fragment_share);
  }


  void
  Recorder::finish(const LoopReport &report)
  {
    if (last_sample_time < bite.time())
      sample();
    log.end_progress();
    {
      const auto timer = log.section("measures");
      find_fragments();
    }
    if (scene.output.fields && last_frame_time < bite.time())
      write_frame();
    if (particle_frames)
      particle_frames->finish();
    for (auto *const frames : {plate_frames.get(), elastic_frames.get()})
      if (frames)
        frames->finish();
    if (surface_frames)
      surface_frames->finish();
    write_fragments();

    summarise_stroke(stop_reason());
    summarise_plates();
    summarise_surfaces();
    drives.summarise(summary);
    tooth_cracks.summarise(summary);
    summarise_break();
    summarise_fragments();
    summarise_new_surface();
    summarise_fragment_sizes();
    summarise_ledgers();
    summarise_run();
    summarise_effects();
    add_loop_report(summary, report);
    if (first_rank)
      summary.write(options.output_directory + "/summary.json");
  }
} // namespace Morsel
