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


    /// The particles near a side whose surface vectors are its own: they
    /// differ from zero up to two supports from the edge, but also near the
    /// opposite edge and at the faces of cracks, which bear no load.
    struct SideBand
    {
      unsigned int axis;
      double       sign, edge, reach; ///< place and depth along the axis [m]

      SideBand(const Condition &condition, const Scene::ParticleBody &body)
          : axis(normal_axis(condition.side()))
          , sign(is_upper(condition.side()) ? 1. : -1.)
          , edge(is_upper(condition.side()) ? body.shape.upper_corner[axis]
                                            : body.shape.lower_corner[axis])
          , reach(
                std::min(0.5 * body.shape.extent(axis),
                         2. * Kernel(kernel_named(body.solid.kernel),
                                     body.solid.smoothing_ratio * body.spacing)
                                  .support()))
      {}

      bool
      contains(const dealii::Point<2> &x) const
      {
        return sign * (edge - x[axis]) < reach;
      }
    };
  } // namespace


  AppliedCondition::AppliedCondition(const Condition           &condition,
                                     const Scene::ParticleBody &body,
                                     const DeformableBody      &solid,
                                     const double               depth)
      : condition(condition)
      , value(condition.value)
  {
    if (prescribes_motion())
      prescribe_particles(body, solid);
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

    const SideBand     band(condition, body);
    const unsigned int d               = band.axis;
    normal[d]                          = band.sign;
    const std::vector<Vector2> surface = solid.surface_vectors();
    double                     sum     = 0.;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const double share = band.sign * as_tensor(surface[i])[d];
        if (!band.contains(p.reference[i]) || !concerns(p.reference[i]) ||
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
                                        const DeformableBody      &solid)
  {
    const Particles &p    = solid.get_particles();
    const auto       side = condition.side();
    if (side == Condition::Side::none)
      {
        for (unsigned int i = 0; i < p.n_owned; ++i)
          if (concerns(p.reference[i]))
            prescribed.push_back({{{i}, {1.}, p.mass[i]}});
        return;
      }

    // Identities are row-major in the lattice, and the order of memory.
    const SideBand     band(condition, body);
    const unsigned int d  = band.axis;
    const unsigned int nx = body.particles_across, ny = body.particles_high();
    const unsigned int step  = d == 0 ? 1 : nx;
    const unsigned int along = d == 0 ? ny : nx, across = d == 0 ? nx : ny;
    const std::vector<Vector2> surface = solid.surface_vectors();
    for (unsigned int k = 0; k < along; ++k)
      {
        std::vector<unsigned int> row;
        const unsigned int        base = d == 0 ? k * nx : k;
        for (unsigned int m = 0; m < across; ++m)
          {
            const unsigned int i =
                base + (is_upper(side) ? across - 1 - m : m) * step;
            if (m < 2 || band.contains(p.reference[i]))
              row.push_back(i);
          }
        if (concerns(p.reference[row[0]]))
          prescribed.push_back({trace_at_edge(row, surface, p, band.edge)});
      }
  }


  AppliedCondition::Trace
  AppliedCondition::trace_at_edge(const std::vector<unsigned int> &row,
                                  const std::vector<Vector2>      &surface,
                                  const Particles                 &p,
                                  const double                     edge) const
  {
    // Weights in proportion to the surface vectors: the reaction then is what
    // a constant stress balances, particle by particle.
    const unsigned int d    = normal_axis(condition.side());
    const double       sign = is_upper(condition.side()) ? 1. : -1.;
    Trace              trace;
    double             sum = 0.;
    for (const unsigned int i : row)
      {
        const double w = sign * as_tensor(surface[i])[d];
        if (trace.particle.size() >= 2 &&
            std::abs(w) < 1e-12 * p.volume(i) / p.spacing)
          break;
        trace.particle.push_back(i);
        trace.weight.push_back(w);
        sum += w;
      }
    // In corners and without an exact gradient they miss the edge; the two
    // outermost particles make good for that.
    double place = 0.;
    for (unsigned int m = 0; m < trace.weight.size(); ++m)
      {
        trace.weight[m] /= sum;
        place += trace.weight[m] * p.reference[trace.particle[m]][d];
      }
    const double shift =
        (edge - place) / (p.reference[row[0]][d] - p.reference[row[1]][d]);
    trace.weight[0] += shift;
    trace.weight[1] -= shift;
    double mobility = 0.;
    for (unsigned int m = 0; m < trace.weight.size(); ++m)
      mobility += trace.weight[m] * trace.weight[m] / p.mass[trace.particle[m]];
    trace.mass = 1. / mobility;
    return trace;
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
        for (unsigned int m = 0; m < q.trace.particle.size(); ++m)
          {
            const Vector2 v = velocity(q.trace.particle[m]);
            power +=
                q.trace.weight[m] * (q.reaction.x * v.x + q.reaction.y * v.y);
          }
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
