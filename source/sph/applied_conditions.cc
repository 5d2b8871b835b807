#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/sph/applied_conditions.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// By which prescribed velocities may be missed, over the largest of the
    /// particles that are held.
    constexpr double largest_miss = 1e-3;

    /// Sweeps leave no more than this share of the first gap. Where held sides
    /// meet at a corner they end slowly, but conditions that contradict each
    /// other go on missing by as much as they differ.
    constexpr double largest_remainder = 0.5;


    /// Corrects accelerations until all prescribed velocities hold. Conditions
    /// that meet at a corner share particles: Gauss-Seidel on reactions.
    /// @throws NumericalError where conditions contradict each other
    void
    hold(const std::vector<std::unique_ptr<AppliedCondition>> &conditions,
         Particles                                            &particles,
         const double                                          kick)
    {
      constexpr unsigned int most_sweeps = 500;
      double                 first_gap   = 0.;
      for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
        {
          AppliedCondition::Gap largest{0., 0.};
          for (auto &condition : conditions)
            {
              const auto gap = condition->correct(particles, kick);
              largest        = {std::max(largest.gap, gap.gap),
                                std::max(largest.speed, gap.speed)};
            }
          if (sweep == 0)
            first_gap = largest.gap;
          if (!(largest.gap > 1e-12 * first_gap + 1e-14 * largest.speed))
            break;
          if (sweep + 1 == most_sweeps &&
              largest.gap > largest_miss * largest.speed &&
              largest.gap > largest_remainder * first_gap)
            throw NumericalError(
                "The conditions of body '" + conditions.front()->body() +
                "' prescribe motions that contradict each other (they are "
                "missed by " +
                number_text(largest.gap) + " of " + number_text(largest.speed) +
                " m/s): let each side be moved or held by one of them, and "
                "let those that meet at a corner agree there.");
        }
    }
  } // namespace


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


  AppliedCondition::Gap
  AppliedCondition::correct(Particles &p, const double kick)
  {
    Gap        largest{0., 0.};
    const bool both[2] = {condition.prescribes(0), condition.prescribes(1)};
    for (Prescribed &q : prescribed)
      {
        const unsigned int n     = q.trace.particle.size();
        const auto         solve = [&](double Vector2::*component) {
          double gap = -(q.target.*component);
          for (unsigned int m = 0; m < n; ++m)
            {
              const unsigned int i    = q.trace.particle[m];
              const double       next = p.half_velocity[i].*component +
                                  kick * p.acceleration[i].*component;
              gap += q.trace.weight[m] * next;
              largest.speed = std::max(largest.speed, std::abs(next));
            }
          const double reaction = -gap * q.trace.mass / kick;
          for (unsigned int m = 0; m < n; ++m)
            {
              const unsigned int i = q.trace.particle[m];
              p.acceleration[i].*component +=
                  q.trace.weight[m] * reaction / p.mass[i];
            }
          q.reaction.*component += reaction;
          largest.gap = std::max(largest.gap, std::abs(gap));
        };
        if (both[0])
          solve(&Vector2::x);
        if (both[1])
          solve(&Vector2::y);
      }
    return largest;
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
  {
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      if (scene.conditions[k].body == body.name)
        {
          conditions.push_back(std::make_unique<AppliedCondition>(
              scene.conditions[k], body, solid, scene.depth));
          places.push_back(k);
        }
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
    hold(conditions, particles, kick);
    // A damping needs the velocity to which all else leads, supports too.
    if (damped)
      {
        for (auto &condition : conditions)
          if (condition->is_damping())
            condition->add_forces(particles, time, half_step);
        hold(conditions, particles, kick);
      }
    for (auto &condition : conditions)
      condition->account(particles, half_step, kick);
  }
} // namespace Morsel::SPH
