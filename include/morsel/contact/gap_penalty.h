#ifndef morsel_contact_gap_penalty_h
#define morsel_contact_gap_penalty_h

#include <morsel/contact/plate_contact.h>

namespace Morsel::Contact
{
  /// Pressure from the gap between the edge of a particle, half a spacing
  /// off unless told otherwise, and the nearest facet: f = k (-gap) along
  /// the facet's normal, k = stiffness (lambda + 2 mu) times the depth, times
  /// the width of edge over the spacing.
  class GapPenalty : public PlateContact
  {
  public:
    GapPenalty(const ContactParameters &parameters,
               const ParticleSide      &side,
               const ParticleEdges     &edges);

    double
    stiffness() const override;

  protected:
    dealii::Tensor<1, 2>
    press(const dealii::Point<2>     &x,
          const dealii::Tensor<1, 2> &v,
          const Candidate            &candidate,
          double                      time_step,
          Surface                    &surface) override;

    /// The facet that a particle is nearest to, and where.
    std::pair<unsigned int, Projection>
    nearest_facet(const dealii::Point<2> &x,
                  const Candidate        &candidate,
                  const Surface          &surface) const;

    /// Where a particle's gap begins [m].
    double
    edge_distance(const unsigned int particle) const
    {
      return edges.empty() ? range : edges.of_particle[particle].distance;
    }

    double
    stiffness_of(const unsigned int particle) const override
    {
      return edges.empty()
                 ? k
                 : k * edges.of_particle[particle].width / side.spacing;
    }

    const double        k; ///< of a particle of a lattice [N/m]
    const ParticleEdges edges;
  };


  /// The same for a surface that deforms. A particle stands for the edge of a
  /// body as wide as itself: its gap is that to the mean of the surface over
  /// this width about its foot, and its force is shared among the nodes as
  /// a uniform pressure over that width is. So a uniform pressure reaches
  /// the nodes exactly, whatever the ratio of spacings, and no facet's end is
  /// felt. About a corner (sharper than a polyline bends) the width is cut
  /// down to what is left up to it on either side.
  class AveragedGap : public GapPenalty
  {
  public:
    using GapPenalty::GapPenalty;

    const Touches &
    touches() const override
    {
      return touching;
    }

  protected:
    /// The mean over a particle's width differs from the foot by less than the
    /// width.
    double
    influence() const override;

    void
    begin(const Surface &surface) override;

    dealii::Tensor<1, 2>
    press(const dealii::Point<2>     &x,
          const dealii::Tensor<1, 2> &v,
          const Candidate            &candidate,
          double                      time_step,
          Surface                    &surface) override;

  private:
    /// From a point of a facet along the polyline.
    struct Reach
    {
      double                    length; ///< up to the wanted one [m]
      std::vector<unsigned int> facets; ///< on the way, the first included
    };

    Reach
    walk(const Surface &surface,
         unsigned int   facet,
         double         parameter,
         bool           forwards,
         double         wanted) const;

    void
    add_share(unsigned int node, double weight);

    /// Adds the shares of the nodes to the last touch.
    /// @return the mean normal of the surface there
    dealii::Tensor<1, 2>
    share_over_width(const Surface    &surface,
                     unsigned int      facet,
                     const Projection &foot,
                     double            half_width);

    /// How the force on the surface falls as it moves [N/m].
    dealii::Tensor<2, 2>
    tangent(unsigned int                particle,
            double                      normal_force,
            const dealii::Tensor<1, 2> &normal,
            const dealii::Tensor<1, 2> &rubbing,
            double                      time_step) const;

    Touches                   touching;
    std::vector<unsigned int> next, previous; ///< facets, by facet
  };
} // namespace Morsel::Contact

#endif
