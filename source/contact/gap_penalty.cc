#include <morsel/contact/gap_penalty.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel::Contact
{
  namespace
  {
    /// Facets that meet at more than 30 degrees make a corner, no curve.
    constexpr double cosine_of_corner = 0.866;

    /// Distances to two facets that differ by less are alike, relative.
    constexpr double like_distances = 1e-9;


    /// Of any particle of the whole body.
    ParticleEdge
    largest_edge(const ParticleEdges &edges, const ParticleSide &side)
    {
      return edges.empty() ? ParticleEdge{0.5 * side.spacing, side.spacing}
                           : edges.largest;
    }


    dealii::Tensor<1, 2>
    edge(const Surface &surface, const unsigned int facet)
    {
      const auto [first, second] = surface.facets[facet];
      return surface.nodes[second] - surface.nodes[first];
    }
  } // namespace


  GapPenalty::GapPenalty(const ContactParameters &parameters,
                         const ParticleSide      &side,
                         const ParticleEdges     &edges)
      : PlateContact(parameters, side, largest_edge(edges, side).distance)
      , k(parameters.stiffness * side.p_wave_modulus * side.depth)
      , edges(edges)
  {}


  double
  GapPenalty::stiffness() const
  {
    return k * largest_edge(edges, side).width / side.spacing;
  }


  std::pair<unsigned int, Projection>
  GapPenalty::nearest_facet(const dealii::Point<2> &x,
                            const Candidate        &candidate,
                            const Surface          &surface) const
  {
    Projection   nearest{};
    unsigned int facet = 0;
    double       best  = std::numeric_limits<double>::max();
    for (unsigned int c = candidate.first; c < candidate.last; ++c)
      {
        // Those that follow were further away.
        if (distance_of_near[c] - approach() > (1. + like_distances) * best)
          break;
        const auto p = project(surface, facets_near[c], x);
        // Beyond a corner both of its facets are equally near; if it is sharp,
        // the point may lie behind the line of one: the other one is right.
        const bool sides_differ =
            p.distance * nearest.distance < 0. &&
            std::abs(std::abs(p.distance) - best) < like_distances * best;
        if (sides_differ ? std::abs(p.offset) > std::abs(nearest.offset)
                         : std::abs(p.distance) < best)
          {
            nearest = p;
            best    = std::abs(p.distance);
            facet   = facets_near[c];
          }
      }
    return {facet, nearest};
  }


  dealii::Tensor<1, 2>
  GapPenalty::press(const dealii::Point<2>     &x,
                    const dealii::Tensor<1, 2> &v,
                    const Candidate            &candidate,
                    const double                time_step,
                    Surface                    &surface)
  {
    const auto [facet, nearest] = nearest_facet(x, candidate, surface);
    const unsigned int i        = candidate.particle;
    const double       gap      = nearest.distance - edge_distance(i);
    if (gap >= 0.)
      return {};
    const double k = stiffness_of(i);

    const auto [first, second] = surface.facets[facet];
    const double t             = nearest.parameter;
    const auto   v_surface =
        (1. - t) * surface.velocity[first] + t * surface.velocity[second];
    const auto f =
        -k * gap * nearest.normal +
        friction(i, -k * gap, nearest.normal, v - v_surface, time_step);
    surface.force[first] -= (1. - t) * f;
    surface.force[second] -= t * f;
    energy += 0.5 * k * gap * gap;
    penetration = std::max(penetration, -gap);
    return f;
  }


  double
  AveragedGap::influence() const
  {
    return range + largest_edge(edges, side).width;
  }


  void
  AveragedGap::begin(const Surface &surface)
  {
    touching.clear();
    if (next.size() == surface.facets.size())
      return;
    const unsigned int        n = surface.facets.size();
    std::vector<unsigned int> beginning(surface.nodes.size());
    for (unsigned int f = 0; f < n; ++f)
      beginning[surface.facets[f].first] = f;
    next.resize(n);
    previous.resize(n);
    for (unsigned int f = 0; f < n; ++f)
      {
        next[f]           = beginning[surface.facets[f].second];
        previous[next[f]] = f;
      }
  }


  AveragedGap::Reach
  AveragedGap::walk(const Surface     &surface,
                    const unsigned int facet,
                    const double       parameter,
                    const bool         forwards,
                    const double       wanted) const
  {
    auto   along = edge(surface, facet);
    double size  = along.norm();
    Reach  reach{(forwards ? 1. - parameter : parameter) * size, {facet}};
    while (reach.length < wanted)
      {
        const unsigned int f         = forwards ? next[reach.facets.back()]
                                                : previous[reach.facets.back()];
        const auto         following = edge(surface, f);
        const double       length    = following.norm();
        if (following * along < cosine_of_corner * length * size)
          return reach;
        reach.facets.push_back(f);
        reach.length += length;
        along = following;
        size  = length;
      }
    reach.length = wanted;
    return reach;
  }


  void
  AveragedGap::add_share(const unsigned int node, const double weight)
  {
    auto &touch = touching.list.back();
    for (unsigned int s = touch.first; s < touch.last; ++s)
      if (touching.shares[s].first == node)
        {
          touching.shares[s].second += weight;
          return;
        }
    touching.shares.emplace_back(node, weight);
    ++touch.last;
  }


  dealii::Tensor<1, 2>
  AveragedGap::share_over_width(const Surface     &surface,
                                const unsigned int facet,
                                const Projection  &foot,
                                const double       half_width)
  {
    const auto ahead  = walk(surface, facet, foot.parameter, true, half_width);
    const auto behind = walk(surface, facet, foot.parameter, false, half_width);
    const double a    = std::min(ahead.length, behind.length);
    if (a < 1e-9 * half_width)
      {
        add_share(surface.facets[facet].first, 1. - foot.parameter);
        add_share(surface.facets[facet].second, foot.parameter);
        return foot.normal;
      }
    dealii::Tensor<1, 2> along;
    for (const bool forwards : {true, false})
      {
        double rest = a;
        double from = foot.parameter;
        for (const unsigned int f : (forwards ? ahead : behind).facets)
          {
            const auto [first, second] = surface.facets[f];
            const auto   direction     = edge(surface, f);
            const double length        = direction.norm();
            const double room          = (forwards ? 1. - from : from) * length;
            const double way           = std::min(rest, room);
            const double middle = from + (forwards ? 0.5 : -0.5) * way / length;
            add_share(first, 0.5 * way / a * (1. - middle));
            add_share(second, 0.5 * way / a * middle);
            along += way / length * direction;
            rest -= way;
            from = forwards ? 0. : 1.;
            if (rest <= 0.)
              break;
          }
      }
    return dealii::Tensor<1, 2>({along[1], -along[0]}) / along.norm();
  }


  dealii::Tensor<2, 2>
  AveragedGap::tangent(const unsigned int          particle,
                       const double                normal_force,
                       const dealii::Tensor<1, 2> &normal,
                       const dealii::Tensor<1, 2> &rubbing,
                       const double                time_step) const
  {
    const double k    = stiffness_of(particle);
    auto         K    = k * outer_product(normal, normal);
    const double most = parameters.friction * normal_force;
    if (most <= 0.)
      return K;
    // What stops a slip is proportional to it; sliding goes by the pressure.
    if (rubbing.norm() < (1. - 1e-12) * most)
      {
        const dealii::Tensor<1, 2> along({-normal[1], normal[0]});
        K += sticking_stiffness(particle, time_step) *
             outer_product(along, along);
      }
    else
      K += k / normal_force * outer_product(rubbing, normal);
    return K;
  }


  dealii::Tensor<1, 2>
  AveragedGap::press(const dealii::Point<2>     &x,
                     const dealii::Tensor<1, 2> &v,
                     const Candidate            &candidate,
                     const double                time_step,
                     Surface                    &surface)
  {
    const auto [facet, foot] = nearest_facet(x, candidate, surface);
    const unsigned int i     = candidate.particle;
    const double       width =
        edges.empty() ? side.spacing : edges.of_particle[i].width;
    // The mean over the width differs from the foot by less than the width.
    if (foot.distance - edge_distance(i) > width)
      return {};

    const unsigned int first = touching.shares.size();
    touching.list.push_back({{}, first, first});
    const auto       n = share_over_width(surface, facet, foot, 0.5 * width);
    dealii::Point<2> mean;
    dealii::Tensor<1, 2> v_surface;
    for (unsigned int s = first; s < touching.shares.size(); ++s)
      {
        const auto [node, share] = touching.shares[s];
        mean += share * surface.nodes[node];
        v_surface += share * surface.velocity[node];
      }
    const double gap = (x - mean) * n - edge_distance(i);
    if (gap >= 0.)
      {
        touching.list.pop_back();
        touching.shares.resize(first);
        return {};
      }
    const double k       = stiffness_of(i);
    const auto   rubbing = friction(i, -k * gap, n, v - v_surface, time_step);
    const auto   f       = -k * gap * n + rubbing;
    touching.list.back().stiffness =
        tangent(i, -k * gap, n, rubbing, time_step);
    for (unsigned int s = first; s < touching.shares.size(); ++s)
      surface.force[touching.shares[s].first] -= touching.shares[s].second * f;
    energy += 0.5 * k * gap * gap;
    penetration = std::max(penetration, -gap);
    return f;
  }
} // namespace Morsel::Contact
