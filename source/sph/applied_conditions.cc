#include <morsel/core/errors.h>
#include <morsel/core/kernel.h>
#include <morsel/sph/applied_conditions.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using Scene::Condition;

  namespace
  {
    /// The axis across a side, 0: x, 1: y.
    unsigned int
    normal_axis(const Condition::Side side)
    {
      return side == Condition::Side::left || side == Condition::Side::right
                 ? 0
                 : 1;
    }


    bool
    is_upper(const Condition::Side side)
    {
      return side == Condition::Side::right || side == Condition::Side::top;
    }


    dealii::Tensor<1, 2>
    as_tensor(const Vector2 &v)
    {
      dealii::Tensor<1, 2> t;
      t[0] = v.x;
      t[1] = v.y;
      return t;
    }


    /// Corrects accelerations until all prescribed velocities hold. Conditions
    /// that meet at a corner share particles: Gauss-Seidel on reactions.
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
        }
    }
  } // namespace


  AppliedCondition::AppliedCondition(const Condition           &condition,
                                     const Scene::ParticleBody &body,
                                     const DeformableBody      &solid,
                                     const double               depth)
      : condition(condition)
      , value(condition.value)
  {
    if (prescribes_motion())
      prescribe_particles(body, solid.get_particles());
    else
      load_particles(body, solid, depth);
  }


  bool
  AppliedCondition::concerns(const dealii::Point<2> &x) const
  {
    if (!condition.has_box())
      return true;
    // Along a side, only the extent along it counts.
    const auto side = condition.side();
    for (unsigned int d = 0; d < 2; ++d)
      if (side == Condition::Side::none || d != normal_axis(side))
        if (x[d] < condition.box.lower_corner[d] ||
            x[d] > condition.box.upper_corner[d])
          return false;
    return true;
  }


  void
  AppliedCondition::load_particles(const Scene::ParticleBody &body,
                                   const DeformableBody      &solid,
                                   const double               depth)
  {
    const Particles &p    = solid.get_particles();
    const auto       side = condition.side();
    if (side == Condition::Side::none ||
        (condition.kind != "traction" && condition.kind != "pressure"))
      {
        for (unsigned int i = 0; i < p.n_owned; ++i)
          if (concerns(p.reference[i]))
            loaded.push_back({i, p.mass[i], {0., 0.}});
        if (condition.kind == "force")
          for (Loaded &l : loaded)
            l.share = 1. / loaded.size();
        return;
      }

    // Surface vectors differ from zero up to two supports from the edge, and
    // from the opposite edge and the faces of cracks, which bear no load.
    const unsigned int d    = normal_axis(side);
    const double       sign = is_upper(side) ? 1. : -1.;
    const double       edge = is_upper(side) ? body.shape.upper_corner[d]
                                             : body.shape.lower_corner[d];
    const double       reach =
        std::min(0.5 * body.shape.extent(d),
                 2. * Kernel(kernel_named(body.solid.kernel),
                             body.solid.smoothing_ratio * body.spacing)
                          .support());
    normal[d]                          = sign;
    const std::vector<Vector2> surface = solid.surface_vectors();
    double                     sum     = 0.;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const double share = sign * as_tensor(surface[i])[d];
        if (sign * (edge - p.reference[i][d]) >= reach ||
            !concerns(p.reference[i]) ||
            std::abs(share) < 1e-12 * p.volume(i) / p.spacing)
          continue;
        loaded.push_back({i, share, {0., 0.}});
        sum += share;
      }
    double length = body.shape.extent(1 - d);
    if (condition.has_box())
      length = std::min(condition.box.upper_corner[1 - d],
                        body.shape.upper_corner[1 - d]) -
               std::max(condition.box.lower_corner[1 - d],
                        body.shape.lower_corner[1 - d]);
    for (Loaded &l : loaded)
      l.share *= length * depth / sum;
  }


  void
  AppliedCondition::prescribe_particles(const Scene::ParticleBody &body,
                                        const Particles           &p)
  {
    const auto side = condition.side();
    if (side == Condition::Side::none)
      {
        for (unsigned int i = 0; i < p.n_owned; ++i)
          if (concerns(p.reference[i]))
            prescribed.push_back({i, i, 1., {0., 0.}, {0., 0.}});
        return;
      }

    // Identities are row-major in the lattice, and the order of memory.
    const unsigned int d  = normal_axis(side);
    const unsigned int nx = body.particles_across, ny = body.particles_high();
    const unsigned int step  = d == 0 ? 1 : nx;
    const unsigned int along = d == 0 ? ny : nx;
    const double       edge  = is_upper(side) ? body.shape.upper_corner[d]
                                              : body.shape.lower_corner[d];
    for (unsigned int k = 0; k < along; ++k)
      {
        const unsigned int base = d == 0 ? k * nx : k;
        const unsigned int last = base + ((d == 0 ? nx : ny) - 1) * step;
        const unsigned int i    = is_upper(side) ? last : base;
        const unsigned int j    = is_upper(side) ? i - step : i + step;
        if (!concerns(p.reference[i]))
          continue;
        const double x1 = p.reference[i][d], x2 = p.reference[j][d];
        prescribed.push_back(
            {i, j, (edge - x2) / (x1 - x2), {0., 0.}, {0., 0.}});
      }
  }


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
        const dealii::Tensor<1, 2> start =
            q.c * as_tensor(p.half_velocity[q.first]) +
            (1. - q.c) * as_tensor(p.half_velocity[q.second]);
        const dealii::Tensor<1, 2> place =
            q.c * p.position(q.first) + (1. - q.c) * p.position(q.second);
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
        const bool   pair = q.first != q.second;
        const double b    = pair ? 1. - q.c : 0.;
        const double m1 = p.mass[q.first], m2 = p.mass[q.second];
        const double unit  = 1. / (q.c * q.c / m1 + b * b / m2);
        const auto   solve = [&](double Vector2::*component) {
          const auto next = [&](const unsigned int i) {
            return p.half_velocity[i].*component +
                   kick * p.acceleration[i].*component;
          };
          const double gap = q.c * next(q.first) +
                             (pair ? b * next(q.second) : 0.) -
                             q.target.*component;
          const double reaction = -gap * unit / kick;
          p.acceleration[q.first].*component += q.c * reaction / m1;
          if (pair)
            p.acceleration[q.second].*component += b * reaction / m2;
          q.reaction.*component += reaction;
          largest.gap   = std::max(largest.gap, std::abs(gap));
          largest.speed = std::max(largest.speed, std::abs(next(q.first)));
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
    const auto velocity = [&](const unsigned int i) {
      return Vector2{p.half_velocity[i].x + half_step * p.acceleration[i].x,
                     p.half_velocity[i].y + half_step * p.acceleration[i].y};
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
        const Vector2 v = velocity(q.first), w = velocity(q.second);
        power += q.reaction.x * (q.c * v.x + (1. - q.c) * w.x) +
                 q.reaction.y * (q.c * v.y + (1. - q.c) * w.y);
        total.x += q.reaction.x;
        total.y += q.reaction.y;
      }
    to_come         = power * kick;
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
    const double half_step = started ? 0.5 * time_step : 0.;
    const double kick      = half_step + 0.5 * time_step;
    started                = true;
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
