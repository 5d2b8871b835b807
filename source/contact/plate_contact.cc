#include <morsel/contact/facet_grid.h>
#include <morsel/contact/gap_penalty.h>
#include <morsel/contact/plate_contact.h>
#include <morsel/core/kernel.h>
#include <morsel/core/state_archive.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel::Contact
{
  namespace
  {
    /// The search reaches this many spacings beyond the range.
    constexpr double margin_in_spacings = 3.;


    /// The thesis's potential (T4-1 to T4-3, sign corrected) between a
    /// particle and the nodes of the surface: areas times depth stand for
    /// the volumes, K = kappa E / dp^2. The force at the range is taken off, so
    /// that it sets in without a step: a step would make or take energy at
    /// every crossing, as much as the leapfrog step is long.
    class NodePotential : public PlateContact
    {
    public:
      NodePotential(const ContactParameters &parameters,
                    const ParticleSide      &side)
          : PlateContact(parameters, side, 1.5 * side.spacing)
          , kernel(KernelKind::cubic_b_spline, side.smoothing_length)
          , at_spacing(kernel.value(side.spacing))
          , scale(parameters.potential_kappa * side.youngs_modulus *
                  side.depth * side.spacing)
          , n(parameters.potential_exponent)
          , at_range(power(range))
          , slope_at_range(slope(range))
      {}

      double
      stiffness() const override
      {
        // Curvature of the potential at one spacing, nodes half a spacing
        // apart: about n^2 (W'/W)^2 phi per node, over three nodes.
        const double slope =
            side.spacing * kernel.gradient_weight(side.spacing) / at_spacing;
        return 3. * scale * 0.5 * side.spacing * n * n * slope * slope;
      }

    protected:
      dealii::Tensor<1, 2>
      press(const dealii::Point<2>     &x,
            const dealii::Tensor<1, 2> &v,
            const Candidate            &candidate,
            const double                time_step,
            Surface                    &surface) override
      {
        dealii::Tensor<1, 2> sum, v_nodes;
        double               weights = 0.;
        shares.clear();
        for (unsigned int c = candidate.first; c < candidate.last; ++c)
          {
            // Each node is the first of one facet of a closed surface.
            const unsigned int j    = surface.facets[facets_near[c]].first;
            const auto         away = x - surface.nodes[j];
            const double       r    = away.norm();
            if (r >= range || r == 0.)
              continue;
            const double phi = scale * surface.tributary[j];
            const auto   f   = phi * (slope_at_range - slope(r)) / r * away;
            sum += f;
            surface.force[j] -= f;
            shares.emplace_back(j, f.norm());
            weights += shares.back().second;
            v_nodes += shares.back().second * surface.velocity[j];
            energy +=
                phi * (power(r) - at_range - slope_at_range * (r - range));
            penetration = std::max(penetration, 0.5 * side.spacing - r);
          }
        const double size = sum.norm();
        if (size == 0.)
          return sum;

        // One friction for the nodes together: one each could turn the
        // particle's slip around.
        const auto normal  = sum / size;
        const auto rubbing = friction(
            candidate.particle, size, normal, v - v_nodes / weights, time_step);
        for (const auto &[j, share] : shares)
          surface.force[j] -= share / weights * rubbing;
        return sum + rubbing;
      }

    private:
      /// (W(r)/W(dp))^n.
      double
      power(const double r) const
      {
        return std::pow(kernel.value(r) / at_spacing, n);
      }

      /// Its derivative [1/m].
      double
      slope(const double r) const
      {
        return -n * power(r) / kernel.value(r) * r * kernel.gradient_weight(r);
      }

      const Kernel kernel;
      const double at_spacing; ///< W(dp) [1/m^2]
      const double scale;      ///< V_i K per length of surface [J/m]
      const double n;
      const double at_range;       ///< power() where the force ends
      const double slope_at_range; ///< [1/m]
      /// Nodes that press on the particle at hand, with the size of each force.
      std::vector<std::pair<unsigned int, double>> shares;
    };
  } // namespace


  PlateContact::PlateContact(const ContactParameters &parameters,
                             const ParticleSide      &side,
                             const double             range)
      : parameters(parameters)
      , side(side)
      , range(range)
      , margin(margin_in_spacings * side.spacing)
      , slipping_mass(side.mass)
  {}


  const std::vector<ParticleForce> &
  PlateContact::compute(const std::vector<dealii::Point<2>> &reference,
                        const std::vector<Motion>           &motion,
                        const unsigned int                   n_owned,
                        const double                         time_step,
                        Surface                             &surface,
                        const double                         travelled)
  {
    const auto place = [&](const unsigned int i) -> dealii::Point<2> {
      return {reference[i][0] + motion[i].u_x, reference[i][1] + motion[i].u_y};
    };
    if (search_is_due(place, n_owned, surface, travelled))
      {
        search(place, n_owned, surface);
        watch.begin(travelled);
      }
    position.resize(candidates.size());
    for (unsigned int c = 0; c < candidates.size(); ++c)
      position[c] = place(candidates[c].particle);
    heat_before = heat;
    if (parameters.sticks_elastically())
      {
        stretch.resize(n_owned);
        stretch_before = stretch;
      }
    return press_all(motion, time_step, surface);
  }


  const std::vector<ParticleForce> &
  PlateContact::compute_again(const std::vector<Motion> &motion,
                              const double               time_step,
                              Surface                   &surface)
  {
    heat    = heat_before;
    stretch = stretch_before;
    moved   = motion_of(surface);
    return press_all(motion, time_step, surface);
  }


  const std::vector<ParticleForce> &
  PlateContact::press_all(const std::vector<Motion> &motion,
                          const double               time_step,
                          Surface                   &surface)
  {
    energy = penetration = 0.;
    forces.clear();
    begin(surface);
    // What goes along with the surface comes no nearer to it.
    for (unsigned int k = 0; k < candidates.size(); ++k)
      {
        const Candidate     &c = candidates[k];
        dealii::Tensor<1, 2> f;
        approached =
            (position[k] - searched_at[c.particle] - moved.drift).norm() +
            moved.deviation;
        if (c.clearance <= influence() + approached)
          {
            const Motion &m = motion[c.particle];
            f               = press(position[k],
                      dealii::Tensor<1, 2>({m.v_x, m.v_y}),
                      c,
                      time_step,
                      surface);
          }
        if (f[0] != 0. || f[1] != 0.)
          forces.push_back({c.particle, f});
        else if (!stretch.empty())
          stretch[c.particle] = 0.;
      }
    return forces;
  }


  void
  PlateContact::exchange_state(StateArchive &state)
  {
    state.cache(candidates, facets_near, distance_of_near);
    state.cache(searched_at, searched_nodes);
    state.particles(stretch, stretch_before);
    state.sum(energy, heat, heat_before);
    if (state.loads())
      watch.forget();
  }


  const Touches &
  PlateContact::touches() const
  {
    AssertThrow(false, dealii::ExcMessage("This law knows no deformation."));
    static const Touches none;
    return none;
  }


  std::vector<unsigned int>
  PlateContact::particles_within(const double   distance,
                                 const Surface &surface) const
  {
    std::vector<unsigned int> list;
    for (unsigned int k = 0; k < candidates.size(); ++k)
      for (unsigned int f = candidates[k].first; f < candidates[k].last; ++f)
        if (std::abs(project(surface, facets_near[f], position[k]).distance) <=
            distance)
          {
            list.push_back(candidates[k].particle);
            break;
          }
    return list;
  }


  PlateContact::SurfaceMotion
  PlateContact::motion_of(const Surface &surface) const
  {
    const unsigned int n = surface.nodes.size();
    SurfaceMotion      motion;
    double             farthest = 0., deviation = 0.;
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto way = surface.nodes[k] - searched_nodes[k];
        motion.drift += way / n;
        farthest = std::max(farthest, way.norm_square());
      }
    for (unsigned int k = 0; k < n; ++k)
      deviation = std::max(
          deviation,
          (surface.nodes[k] - searched_nodes[k] - motion.drift).norm_square());
    motion.farthest  = std::sqrt(farthest);
    motion.deviation = std::sqrt(deviation);
    return motion;
  }


  template <typename Position>
  bool
  PlateContact::search_is_due(const Position    &place,
                              const unsigned int n_owned,
                              const Surface     &surface,
                              const double       travelled)
  {
    // A rank may have no particles at all.
    if (searched_at.size() != n_owned ||
        searched_nodes.size() != surface.nodes.size())
      return true;
    const double limit = 0.5 * margin;
    moved              = motion_of(surface);
    return moved.farthest > limit || watch.beyond(limit, travelled, [&] {
      double largest = 0.;
      for (unsigned int i = 0; i < n_owned; ++i)
        largest = std::max(largest, (place(i) - searched_at[i]).norm_square());
      return largest;
    });
  }


  template <typename Position>
  void
  PlateContact::search(const Position    &place,
                       const unsigned int n_owned,
                       const Surface     &surface)
  {
    searched_nodes = surface.nodes;
    moved          = {};
    searched_at.resize(n_owned);
    candidates.clear();
    facets_near.clear();
    distance_of_near.clear();
    std::vector<std::pair<double, unsigned int>> near;

    const double    reach = range + margin;
    const FacetGrid grid(surface, reach);
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        searched_at[i] = place(i);
        near.clear();
        const auto [begin, end] = grid.near(searched_at[i]);
        double clearance        = reach;
        for (unsigned int c = begin; c < end; ++c)
          {
            const unsigned int f = grid.candidates()[c];
            const double       d = project(surface, f, searched_at[i]).distance;
            if (std::abs(d) >= reach)
              continue;
            near.emplace_back(std::abs(d), f);
            clearance = std::min(clearance, d);
          }
        std::sort(near.begin(), near.end());
        const unsigned int first = facets_near.size();
        for (const auto &[distance, f] : near)
          {
            facets_near.push_back(f);
            distance_of_near.push_back(distance);
          }
        if (!near.empty())
          candidates.push_back({i,
                                first,
                                static_cast<unsigned int>(facets_near.size()),
                                0,
                                clearance});
      }
  }


  dealii::Tensor<1, 2>
  PlateContact::friction(const unsigned int          particle,
                         const double                normal_force,
                         const dealii::Tensor<1, 2> &normal,
                         const dealii::Tensor<1, 2> &relative,
                         const double                time_step)
  {
    if (parameters.friction == 0.)
      return {};
    const auto   slip = relative - (relative * normal) * normal;
    const double most = parameters.friction * normal_force;
    if (parameters.sticks_elastically())
      return spring_friction(particle, most, normal, slip, time_step);
    const double speed = slip.norm();
    if (speed == 0.)
      return {};
    const double size =
        std::min(most, stopped_slip * slipping_mass * speed / time_step);
    heat += size * speed * time_step;
    return -size / speed * slip;
  }


  /// Elastic stick and plastic slip by return mapping (Wriggers, Computational
  /// Contact Mechanics, 2nd ed. 2006, section 5.2.3).
  dealii::Tensor<1, 2>
  PlateContact::spring_friction(const unsigned int          particle,
                                const double                most,
                                const dealii::Tensor<1, 2> &normal,
                                const dealii::Tensor<1, 2> &slip,
                                const double                time_step)
  {
    const double k      = stiffness_of(particle);
    auto        &s      = stretch[particle];
    const double before = s.norm_square();
    const auto   way    = time_step * slip;
    s -= (s * normal) * normal;
    s += way;
    if (const double length = s.norm(); k * length > most)
      s *= most / (k * length);
    // What the force takes over the step at hand and does not store.
    heat += k * (s * way) - 0.5 * k * (s.norm_square() - before);
    energy += 0.5 * k * s.norm_square();
    return -k * s;
  }


  std::unique_ptr<PlateContact>
  make_plate_contact(const ContactParameters &parameters,
                     const ParticleSide      &side,
                     const ParticleEdges     &edges,
                     const bool               deformable)
  {
    if (parameters.law == "potential")
      return std::make_unique<NodePotential>(parameters, side);
    if (deformable)
      return std::make_unique<AveragedGap>(parameters, side, edges);
    return std::make_unique<GapPenalty>(parameters, side, edges);
  }
} // namespace Morsel::Contact
