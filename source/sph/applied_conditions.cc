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
  AppliedCondition::set_targets(const Particles &p,
                                const double     time,
                                const double     time_step)
  {
    // The velocity of the half step belongs to the place halfway, on which
    // it depends itself: a few substitutions turn a body rigidly to round-off.
    const auto at_once = value(dealii::Point<2>(), time + 0.5 * time_step);
    for (Prescribed &q : prescribed)
      {
        q.reaction = {0., 0.};
        if (condition.kind != "velocity")
          {
            q.target = {0., 0.};
            continue;
          }
        if (value.is_uniform())
          {
            q.target = {at_once[0], at_once[1]};
            continue;
          }
        dealii::Tensor<1, 2> start, place;
        for (unsigned int m = 0; m < q.trace.particle.size(); ++m)
          {
            const unsigned int i = q.trace.particle[m];
            start += q.trace.weight[m] * as_tensor(p.half_velocity[i]);
            place += q.trace.weight[m] * dealii::Tensor<1, 2>(p.position(i));
          }
        dealii::Tensor<1, 2> v = start;
        for (unsigned int k = 0; k < 5; ++k)
          v = value(dealii::Point<2>(place + 0.5 * time_step * v),
                    time + 0.5 * time_step);
        q.target = {v[0], v[1]};
      }
  }


  void
  AppliedCondition::list_constraints(const unsigned int         component,
                                     std::vector<Prescribed *> &list)
  {
    if (condition.prescribes(component))
      for (Prescribed &q : prescribed)
        list.push_back(&q);
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
  {
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      if (scene.conditions[k].body == body.name)
        {
          conditions.push_back(std::make_unique<AppliedCondition>(
              scene.conditions[k], body, solid, scene.depth));
          places.push_back(k);
        }
    std::vector<Prescribed *> in_x, in_y;
    for (auto &condition : conditions)
      {
        condition->list_constraints(0, in_x);
        condition->list_constraints(1, in_y);
      }
    constraints = std::make_unique<VelocityConstraints>(
        std::move(in_x), std::move(in_y), solid.get_particles().mass);
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
        condition->set_targets(particles, time, time_step);
      }
    constraints->enforce(particles, kick, name);
    // A damping needs the velocity to which all else leads, supports too.
    if (damped)
      {
        for (auto &condition : conditions)
          if (condition->is_damping())
            condition->add_forces(particles, time, half_step);
        constraints->enforce(particles, kick, name);
      }
    for (auto &condition : conditions)
      condition->account(particles, half_step, kick);
  }
} // namespace Morsel::SPH
