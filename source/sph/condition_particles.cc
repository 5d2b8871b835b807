#include <morsel/core/errors.h>
#include <morsel/core/kernel.h>
#include <morsel/sph/applied_conditions.h>

#include <algorithm>
#include <cmath>

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
            prescribed.push_back({{{i}, {1.}}});
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


  Trace
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
    return trace;
  }
} // namespace Morsel::SPH
