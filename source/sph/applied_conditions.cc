#include <morsel/sph/applied_conditions.h>

#include <cmath>
#include <utility>

namespace Morsel::SPH
{
  void
  AppliedCondition::add_forces(Particles   &p,
                               const double time,
                               const double half_step)
  {
    if (loaded.empty())
      return;
    const bool           uniform = value.is_uniform();
    dealii::Tensor<1, 2> f       = value(dealii::Point<2>(), time);
    for (Loaded &l : loaded)
      {
        if (!uniform)
          f = value(p.position(l.particle), time);
        Vector2     &a    = p.acceleration[l.particle];
        const double mass = p.mass[l.particle];
        if (is_damping())
          {
            // At the velocity of this moment, which it changes itself.
            const Vector2 v = p.half_velocity[l.particle];
            l.force.x       = -mass * f[0] * (v.x + half_step * a.x) /
                        (1. + f[0] * half_step);
            l.force.y = -mass * f[1] * (v.y + half_step * a.y) /
                        (1. + f[1] * half_step);
          }
        else
          {
            const dealii::Tensor<1, 2> load = condition.traction(f, normal);
            l.force = {l.share * load[0], l.share * load[1]};
          }
        a.x += l.force.x / mass;
        a.y += l.force.y / mass;
      }
  }


  void
  AppliedCondition::set_targets(const Particles             &p,
                                const double                 time,
                                const double                 time_step,
                                const ParticleHost<2> *const ranks)
  {
    const bool moves    = condition.kind == "velocity";
    const bool at_place = moves && !value.is_uniform();
    // The velocity of the half step belongs to the place halfway, on which
    // it depends itself: a few substitutions turn a body rigidly to round-off.
    const auto at_once = value(dealii::Point<2>(), time + 0.5 * time_step);
    for (Prescribed &q : prescribed)
      {
        q.reaction = {0., 0.};
        q.target   = moves ? Vector2{at_once[0], at_once[1]} : Vector2{0., 0.};
      }
    if (!at_place)
      return;

    // Velocity and place of each trace.
    std::vector<double> means(4 * prescribed.size(), 0.);
    for (unsigned int k = 0; k < prescribed.size(); ++k)
      {
        const Trace &trace = prescribed[k].trace;
        for (unsigned int m = 0; m < trace.particle.size(); ++m)
          {
            const unsigned int i             = trace.particle[m];
            const auto         x             = p.position(i);
            const double       of_particle[] = {
                      p.half_velocity[i].x, p.half_velocity[i].y, x[0], x[1]};
            for (unsigned int c = 0; c < 4; ++c)
              means[4 * k + c] += trace.weight[m] * of_particle[c];
          }
      }
    if (n_own < prescribed.size())
      ranks->sum(dealii::ArrayView<double>(means.data() + 4 * n_own,
                                           4 * (prescribed.size() - n_own)));
    for (unsigned int k = 0; k < prescribed.size(); ++k)
      {
        const double *const    mean = &means[4 * k];
        const dealii::Point<2> place(mean[2], mean[3]);
        dealii::Tensor<1, 2>   v({mean[0], mean[1]});
        for (unsigned int n = 0; n < 5; ++n)
          v = value(place + 0.5 * time_step * v, time + 0.5 * time_step);
        prescribed[k].target = {v[0], v[1]};
      }
  }


  TracesOfCondition
  AppliedCondition::whole_traces() const
  {
    return {{condition.prescribes(0), condition.prescribes(1)}, traces};
  }


  void
  AppliedCondition::set_traces(const std::vector<WholeTrace> &own,
                               std::vector<Prescribed>        shared_by_ranks,
                               const LocalNumbers            &owned)
  {
    traces.clear();
    n_own = own.size();
    for (const WholeTrace &trace : own)
      {
        prescribed.emplace_back();
        prescribed.back().trace.weight = trace.weight;
        for (const unsigned long long id : trace.id)
          prescribed.back().trace.particle.push_back(owned.find(id));
      }
    prescribed.insert(
        prescribed.end(), shared_by_ranks.begin(), shared_by_ranks.end());
  }


  void
  AppliedCondition::list_constraints(const unsigned int         component,
                                     const bool                 shared,
                                     std::vector<Prescribed *> &list)
  {
    if (condition.prescribes(component))
      for (unsigned int k = shared ? n_own : 0;
           k < (shared ? prescribed.size() : n_own);
           ++k)
        list.push_back(&prescribed[k]);
  }


  void
  AppliedCondition::take_part_of_rank(const std::vector<unsigned long long> &id,
                                      const LocalNumbers &owned)
  {
    for (unsigned int k = n_own; k < prescribed.size(); ++k)
      prescribed[k].trace = part_of_rank(prescribed[k].trace, id, owned);
  }


  void
  AppliedCondition::account(const Particles &p,
                            const double     half_step,
                            const double     kick)
  {
    // The mean of the velocities before and after the kick: times the impulse
    // it is the change of the kinetic energy, also where motion sets in with a
    // jump.
    const auto velocity = [&](const unsigned int i) {
      return Vector2{p.half_velocity[i].x + 0.5 * kick * p.acceleration[i].x,
                     p.half_velocity[i].y + 0.5 * kick * p.acceleration[i].y};
    };
    done += to_come;
    given.x += impulse_to_come.x;
    given.y += impulse_to_come.y;
    total        = {0., 0.};
    double power = 0.;
    for (const Loaded &l : loaded)
      {
        const Vector2 v = velocity(l.particle);
        power += l.force.x * v.x + l.force.y * v.y;
        total.x += l.force.x;
        total.y += l.force.y;
      }
    for (const Prescribed &q : prescribed)
      {
        for (unsigned int m = 0; m < q.trace.particle.size(); ++m)
          {
            const Vector2 v = velocity(q.trace.particle[m]);
            power +=
                q.trace.weight[m] * (q.reaction.x * v.x + q.reaction.y * v.y);
          }
        if (!q.counts)
          continue;
        total.x += q.reaction.x;
        total.y += q.reaction.y;
      }
    to_come = power * kick;
    // work() takes half of what is to come for done; at first nothing is.
    if (half_step == 0.)
      {
        done -= to_come;
        to_come *= 2.;
      }
    impulse_to_come = {total.x * kick, total.y * kick};
  }


  AppliedConditions::AppliedConditions(const Scene::Scene        &scene,
                                       const Scene::ParticleBody &body,
                                       const DeformableBody      &solid)
      : name(body.name)
      , ranks(solid.ranks())
  {
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      if (scene.conditions[k].body == body.name)
        {
          conditions.push_back(std::make_unique<AppliedCondition>(
              scene.conditions[k], body, solid, scene.depth));
          places.push_back(k);
        }
    place_traces(solid.get_particles());
  }


  void
  AppliedConditions::place_traces(const Particles &p)
  {
    const LocalNumbers owned({p.id.begin(), p.id.begin() + p.n_owned});
    std::vector<TracesOfCondition> traces;
    for (const auto &condition : conditions)
      traces.push_back(condition->whole_traces());
    SharedTraces of_ranks;
    if (ranks)
      of_ranks = take_shared_traces(traces, owned, p, *ranks);
    of_ranks.prescribed.resize(conditions.size());
    for (unsigned int c = 0; c < conditions.size(); ++c)
      conditions[c]->set_traces(
          traces[c].traces, std::move(of_ranks.prescribed[c]), owned);

    const auto make = [&](const bool                 is_shared,
                          const std::vector<double> &mass) {
      std::vector<Prescribed *> in_x, in_y;
      for (auto &condition : conditions)
        {
          condition->list_constraints(0, is_shared, in_x);
          condition->list_constraints(1, is_shared, in_y);
        }
      return std::make_unique<const VelocityConstraints>(
          std::move(in_x), std::move(in_y), mass);
    };
    constraints = make(false, p.mass);
    shared      = make(true, of_ranks.mass);
    for (auto &condition : conditions)
      condition->take_part_of_rank(of_ranks.id, owned);
  }


  void
  AppliedConditions::enforce(Particles &particles, const double kick) const
  {
    constraints->enforce(particles, kick, name);
    shared->enforce(particles, kick, name, ranks);
  }


  void
  AppliedConditions::apply(DeformableBody &solid,
                           const double    time,
                           const double    time_step)
  {
    const double half_step = 0.5 * last_step;
    const double kick      = half_step + 0.5 * time_step;
    last_step              = time_step;
    Particles &particles   = solid.state();
    bool       damped      = false;
    for (auto &condition : conditions)
      {
        damped = damped || condition->is_damping();
        if (!condition->is_damping())
          condition->add_forces(particles, time, half_step);
        condition->set_targets(particles, time, time_step, ranks);
      }
    enforce(particles, kick);
    // A damping needs the velocity to which all else leads, supports too.
    if (damped)
      {
        for (auto &condition : conditions)
          if (condition->is_damping())
            condition->add_forces(particles, time, half_step);
        enforce(particles, kick);
      }
    for (auto &condition : conditions)
      condition->account(particles, half_step, kick);
  }


  ConditionWork
  work_of_conditions(const std::vector<AppliedConditions> &bodies,
                     const MPI_Comm                        communicator)
  {
    double parts[2] = {0., 0.};
    for (const AppliedConditions &body : bodies)
      for (const auto &condition : body.list())
        if (condition->is_damping())
          parts[1] -= condition->work();
        else
          parts[0] += condition->work();
    if (!bodies.empty())
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(parts, 2),
                                  communicator,
                                  dealii::ArrayView<double>(parts, 2));
    return {parts[0], parts[1]};
  }


  std::vector<dealii::Tensor<1, 2>>
  impulses_of_conditions(const std::vector<AppliedConditions> &bodies,
                         const MPI_Comm                        communicator)
  {
    std::vector<dealii::Tensor<1, 2>> list;
    for (const AppliedConditions &body : bodies)
      for (const auto &condition : body.list())
        list.push_back(dealii::Utilities::MPI::sum(
            as_tensor(condition->impulse()), communicator));
    return list;
  }
} // namespace Morsel::SPH
