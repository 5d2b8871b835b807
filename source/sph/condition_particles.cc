#include <morsel/core/gather.h>
#include <morsel/core/kernel.h>
#include <morsel/sph/applied_conditions.h>

#include <algorithm>
#include <cmath>
#include <map>

// Which particles a condition concerns, with what shares and traces.
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


    /// Where a particle stands among those across a side, from the edge
    /// inwards, and along it. Identities are row-major in the lattice.
    struct LatticePlace
    {
      unsigned int depth, along;

      LatticePlace(const Scene::ParticleBody &body,
                   const Condition::Side      side,
                   const unsigned long long   id)
      {
        const unsigned int nx = body.particles_across;
        const unsigned int x = id % nx, y = id / nx;
        const bool         across_x = normal_axis(side) == 0;
        const unsigned int n        = across_x ? nx : body.particles_high();
        depth                       = across_x ? x : y;
        along                       = across_x ? y : x;
        if (is_upper(side))
          depth = n - 1 - depth;
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
          {
            const double count = solid.sum_over_ranks(loaded.size());
            for (Loaded &l : loaded)
              l.share = 1. / count;
          }
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
    sum           = solid.sum_over_ranks(sum);
    double length = body.shape.extent(1 - d);
    if (condition.has_box())
      length = std::min(condition.box.upper_corner[1 - d],
                        body.shape.upper_corner[1 - d]) -
               std::max(condition.box.lower_corner[1 - d],
                        body.shape.lower_corner[1 - d]);
    for (Loaded &l : loaded)
      l.share *= length * depth / sum;
  }


  std::vector<AppliedCondition::EdgeParticle>
  AppliedCondition::edge_particles(const Scene::ParticleBody &body,
                                   const DeformableBody      &solid) const
  {
    const Particles           &p = solid.get_particles();
    const SideBand             band(condition, body);
    const std::vector<Vector2> surface = solid.surface_vectors();
    std::vector<EdgeParticle>  list;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      if (LatticePlace(body, condition.side(), p.id[i]).depth < 2 ||
          band.contains(p.reference[i]))
        list.push_back({p.id[i],
                        p.reference[i],
                        surface[i],
                        1e-12 * p.volume(i) / p.spacing});
    return solid.ranks() ? gather(list, solid.ranks()->communicator()) : list;
  }


  void
  AppliedCondition::prescribe_particles(const Scene::ParticleBody &body,
                                        const DeformableBody      &solid)
  {
    const Particles &p = solid.get_particles();
    if (condition.side() == Condition::Side::none)
      {
        for (unsigned int i = 0; i < p.n_owned; ++i)
          if (concerns(p.reference[i]))
            traces.push_back({p.id[i], {p.id[i]}, {1.}});
        return;
      }

    const SideBand     band(condition, body);
    const auto         particles = edge_particles(body, solid);
    const unsigned int n_rows =
        band.axis == 0 ? body.particles_high() : body.particles_across;
    // By their depths, which need not follow each other.
    std::vector<std::map<unsigned int, const EdgeParticle *>> rows(n_rows);
    for (const EdgeParticle &particle : particles)
      {
        const LatticePlace place(body, condition.side(), particle.id);
        rows[place.along][place.depth] = &particle;
      }
    for (unsigned int k = 0; k < n_rows; ++k)
      {
        std::vector<const EdgeParticle *> row;
        for (const auto &at_depth : rows[k])
          row.push_back(at_depth.second);
        if (concerns(row[0]->reference))
          traces.push_back(trace_at_edge(k, row, band.edge));
      }
  }


  WholeTrace
  AppliedCondition::trace_at_edge(const unsigned int number,
                                  const std::vector<const EdgeParticle *> &row,
                                  const double edge) const
  {
    // Weights in proportion to the surface vectors: the reaction then is what
    // a constant stress balances, particle by particle.
    const unsigned int d    = normal_axis(condition.side());
    const double       sign = is_upper(condition.side()) ? 1. : -1.;
    WholeTrace         trace{number, {}, {}};
    double             sum = 0.;
    for (const EdgeParticle *const particle : row)
      {
        const double w = sign * as_tensor(particle->surface)[d];
        if (trace.id.size() >= 2 && std::abs(w) < particle->negligible)
          break;
        trace.id.push_back(particle->id);
        trace.weight.push_back(w);
        sum += w;
      }
    // In corners and without an exact gradient they miss the edge; the two
    // outermost particles make good for that.
    double place = 0.;
    for (unsigned int m = 0; m < trace.weight.size(); ++m)
      {
        trace.weight[m] /= sum;
        place += trace.weight[m] * row[m]->reference[d];
      }
    const double shift =
        (edge - place) / (row[0]->reference[d] - row[1]->reference[d]);
    trace.weight[0] += shift;
    trace.weight[1] -= shift;
    return trace;
  }
} // namespace Morsel::SPH
