#include "breaking_recorder.h"
#include "experiment_recorder.h"
#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/sph/body_cracks.h>

#include <algorithm>
#include <cmath>

namespace Morsel
{
  namespace
  {
    /// A force below this share of the tensile strength times the body's
    /// smallest section is noise, not a peak.
    constexpr double smallest_peak = 0.02;


    /// Velocity or load that a condition, the same everywhere, prescribes.
    dealii::Tensor<1, 2>
    drive(const Scene::Condition &condition,
          const VectorExpression &value,
          const double            time)
    {
      dealii::Tensor<1, 2> v = value(dealii::Point<2>(), time);
      for (unsigned int d = 0; d < 2; ++d)
        if (condition.kind == "velocity" && !condition.prescribes(d))
          v[d] = 0.;
      return v;
    }
  } // namespace


  BreakingRecorder::BreakingRecorder(const Scene::Scene &scene,
                                     const Experiment   &experiment)
      : scene(scene)
      , experiment(experiment)
  {
    const auto &bodies = scene.particle_bodies;
    const bool  named  = std::count_if(bodies.begin(),
                                     bodies.end(),
                                     [](const Scene::ParticleBody &body) {
                                       return body.damage.enabled;
                                     }) > 1;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].damage.enabled)
        {
          const auto *solid =
              dynamic_cast<const SPH::Solid *>(experiment.bodies()[b].get());
          AssertThrow(solid != nullptr, dealii::ExcInternalError());
          followed.push_back(
              {b,
               solid,
               named ? "_" + underscored(bodies[b].name) : "",
               Measure::Breakage(*solid, tip_places(bodies[b])),
               tip_suffixes(SPH::cracks_of(bodies[b]), bodies[b], named)});
        }
    if (!active())
      return;
    find_loads();
    stroke = std::make_unique<Measure::Stroke>(stroke_settings());
  }


  void
  BreakingRecorder::find_loads()
  {
    const auto add = [&](const unsigned int k, const bool moves) {
      VectorExpression value(scene.conditions[k].value);
      if (!value.is_uniform())
        return;
      // Known at once or not: what begins at nought gets its direction later.
      loads.push_back({k, std::move(value), moves, {}});
    };
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      if (scene.conditions[k].kind == "velocity")
        {
          const VectorExpression value(scene.conditions[k].value);
          // A foot that is held by a velocity of zero does not load.
          for (const double share : {0., 0.5, 1.})
            if (drive(scene.conditions[k], value, share * scene.time.end_time)
                    .norm() > 0.)
              {
                add(k, true);
                break;
              }
        }
    if (!loads.empty())
      return;
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      for (const char *kind : {"traction", "pressure", "force"})
        if (scene.conditions[k].kind == kind)
          add(k, false);
  }


  Measure::StrokeSettings
  BreakingRecorder::stroke_settings() const
  {
    const auto             &body = scene.particle_bodies[followed[0].body];
    Measure::StrokeSettings s;
    s.height                = body.shape.extent(1);
    s.residual_force        = scene.stop.residual_force;
    s.closure_after_failure = scene.stop.closure_after_failure;
    s.minimum_peak = smallest_peak * body.material.compressive_strength /
                     body.damage.strength_ratio * scene.depth *
                     std::min(body.shape.extent(0), body.shape.extent(1));
    return s;
  }


  bool
  BreakingRecorder::has_failed(const unsigned int body) const
  {
    for (const Followed &f : followed)
      if (f.body == body)
        return f.breakage.first_failure().has_value();
    return false;
  }


  std::vector<int>
  BreakingRecorder::labels(const unsigned int body) const
  {
    for (const Followed &f : followed)
      if (f.body == body)
        return Measure::fragments_of(*f.solid, scene.measures.fragment_share)
            .label;
    return {};
  }


  void
  BreakingRecorder::follow()
  {
    Measure::StrokeSample s;
    s.time          = experiment.time();
    const double dt = s.time > 0. ? experiment.time_step() : 0.;
    for (Loading &load : loads)
      {
        const auto v = drive(
            scene.conditions[load.condition], load.value, s.time - 0.5 * dt);
        if (v.norm() > 0.)
          load.direction = v / v.norm();
        if (load.moves)
          displacement += v.norm() * dt;
        const Vector2 f = experiment.force(load.condition);
        s.normal_force.push_back(load.moves ? f.x * load.direction[0] +
                                                  f.y * load.direction[1]
                                            : std::hypot(f.x, f.y));
      }
    s.tangential_force.assign(s.normal_force.size(), 0.);
    s.closure        = displacement;
    s.strain_energy  = last_strain;
    s.kinetic_energy = last_kinetic;
    if (!loads.empty())
      {
        stroke->add(s);
        if (stroke->time_of_peak() == s.time)
          displacement_at_peak = displacement;
      }
    for (Followed &f : followed)
      {
        const bool whole = !f.breakage.first_failure();
        f.breakage.follow(s.time);
        if (whole && f.breakage.first_failure() && &f == &followed.front() &&
            !loads.empty())
          load_at_first_failure = stroke->mean_force();
      }
  }


  void
  BreakingRecorder::note(const Measure::Energies &e)
  {
    last_strain  = e.strain;
    last_kinetic = e.kinetic;
  }


  bool
  BreakingRecorder::broken() const
  {
    return active() && !loads.empty() && loads.front().moves &&
           has_failed(followed.front().body) && stroke->failed_completely();
  }


  std::vector<std::string>
  BreakingRecorder::columns() const
  {
    std::vector<std::string> c;
    if (!active())
      return c;
    c = {"load [N]", "load_displacement [m]"};
    for (const Followed &f : followed)
      {
        c.push_back("failed_share" + f.suffix + " [1]");
        for (const std::string &tip : f.tips)
          {
            c.push_back("crack_extension" + tip + " [m]");
            c.push_back("crack_tip_speed" + tip + " [m/s]");
          }
      }
    for (const char *name : {"granular_energy",
                             "dissipated_damage",
                             "dissipated_bonds",
                             "dissipated_granular_friction"})
      c.push_back(std::string(name) + " [J]");
    return c;
  }


  std::vector<double>
  BreakingRecorder::row() const
  {
    std::vector<double> r;
    if (!active())
      return r;
    r = {loads.empty() ? 0. : stroke->mean_force(), displacement};
    for (const Followed &f : followed)
      {
        r.push_back(f.solid->failed_share());
        for (const auto &crack : f.breakage.cracks())
          r.insert(r.end(),
                   {crack.extension(), crack.speed(experiment.time())});
      }
    const Measure::Energies e = experiment.energies();
    r.insert(r.end(),
             {e.granular,
              e.dissipated_damage,
              e.dissipated_bonds,
              e.dissipated_granular_friction});
    return r;
  }


  void
  BreakingRecorder::summarise(Output::Summary &summary) const
  {
    if (!active())
      return;
    if (!loads.empty())
      summarise_load(summary);
    for (const Followed &f : followed)
      summarise_body(summary, f);
    const Measure::Energies e   = experiment.energies();
    const auto              add = [&](const std::string &name,
                         const double       value,
                         const std::string &meaning) {
      summary.add(name, value, "J", meaning);
    };
    add("granular_energy", e.granular, "recoverable in failed parts");
    add("damage_energy", e.dissipated_damage, "dissipated by damage growth");
    add("bond_energy",
        e.dissipated_bonds,
        "released when bonds were cut (negative: stored)");
    add("friction_energy",
        e.dissipated_granular_friction,
        "dissipated by friction in failed parts");
    summary.add("seed", scene.seed, "1", "of the flaws");
  }


  void
  BreakingRecorder::summarise_load(Output::Summary &summary) const
  {
    const std::string force =
        "mean force of the conditions that " +
        std::string(loads.front().moves ? "move, along their motion" : "load");
    if (followed.front().breakage.first_failure())
      summary.add("load_at_first_failure",
                  load_at_first_failure,
                  "N",
                  force + ", when the first particle failed");
    if (!loads.front().moves)
      return;
    summary.add(
        "peak_load", stroke->peak_mean_force(), "N", "largest " + force);
    summary.add("peak_load_time", stroke->time_of_peak(), "s", "");
    summary.add("peak_load_displacement",
                displacement_at_peak,
                "m",
                "way that these conditions had come by then, together");
    if (const auto ratio = stroke->kinetic_over_strain_energy())
      summary.add("kinetic_over_strain_energy_before_peak",
                  *ratio,
                  "1",
                  "kinetic over strain energy at 95 % of the peak: below "
                  "0.05 the loading was quasi-static");
    summary.add("complete_failure",
                broken() ? 1. : 0.,
                "1",
                "1 if the load fell below its residual share for good");
  }


  void
  BreakingRecorder::summarise_body(Output::Summary &summary,
                                   const Followed  &f) const
  {
    const auto fragments =
        Measure::fragments_of(*f.solid, scene.measures.fragment_share);
    summary.add("failed_share" + f.suffix,
                fragments.dust_share,
                "1",
                "mass share of failed particles (dust)");
    summary.add("fragment_count" + f.suffix,
                fragments.count,
                "1",
                "pieces of at least the smallest fragment's share of the mass");
    summary.add("largest_fragment_share" + f.suffix,
                fragments.largest_share(),
                "1",
                "mass share of the largest fragment");
    summary.add("inverted_particle_count" + f.suffix,
                f.solid->get_host().sum(f.solid->inverted_count()),
                "1",
                "particles turned inside out at the end: must be 0");
    add_first_failure(summary, f.breakage, f.suffix);
    add_crack_growth(summary, *f.solid, f.breakage, f.tips);
  }


  std::vector<dealii::Point<2>>
  tip_places(const Scene::ParticleBody &body)
  {
    std::vector<dealii::Point<2>> places;
    for (const auto &tip : Fracture::collect_tips(SPH::cracks_of(body)))
      places.push_back(tip.position);
    return places;
  }


  void
  add_first_failure(Output::Summary         &summary,
                    const Measure::Breakage &breakage,
                    const std::string       &suffix)
  {
    const auto &first = breakage.first_failure();
    if (!first)
      return;
    summary.add("first_failure_time" + suffix,
                first->time,
                "s",
                "when the first particle failed");
    const std::string where =
        " of the first particle that failed, in the reference configuration";
    summary.add(
        "first_failure_x" + suffix, first->place[0], "m", "place" + where);
    summary.add(
        "first_failure_y" + suffix, first->place[1], "m", "place" + where);
  }


  void
  add_crack_growth(Output::Summary                &summary,
                   const SPH::Solid               &solid,
                   const Measure::Breakage        &breakage,
                   const std::vector<std::string> &suffixes)
  {
    const double limit = Measure::rayleigh_speed(solid.get_material());
    for (unsigned int k = 0; k < suffixes.size(); ++k)
      {
        const Measure::CrackGrowth &crack  = breakage.cracks()[k];
        const std::string          &suffix = suffixes[k];
        if (k == 0)
          summary.add("rayleigh_speed", limit, "m/s", "of the undamaged solid");
        summary.add("crack_extension" + suffix,
                    crack.extension(),
                    "m",
                    "distance from the initial tip to the farthest failed "
                    "particle that is connected with it");
        if (const auto start = crack.start())
          summary.add("crack_start_time" + suffix,
                      *start,
                      "s",
                      "when the first particle failed at the tip");
        summary.add("crack_tip_speed_largest" + suffix,
                    crack.largest_speed(),
                    "m/s",
                    "mean over an advance of ten spacings, at its largest");
        summary.add("crack_tip_speed_over_rayleigh" + suffix,
                    crack.largest_speed() / limit,
                    "1",
                    "the same over the speed of Rayleigh waves");
        summary.add("crack_branch_count" + suffix,
                    crack.branch_count(),
                    "1",
                    "pieces of the crack beyond three quarters of its "
                    "extension");
      }
  }
} // namespace Morsel
