#ifndef morsel_contact_plate_contact_h
#define morsel_contact_plate_contact_h

#include <morsel/contact/parameters.h>
#include <morsel/contact/surface.h>
#include <morsel/contact/touches.h>
#include <morsel/core/movement_watch.h>
#include <morsel/core/particle_edges.h>
#include <morsel/core/records.h>
#include <morsel/core/state_archive_fwd.h>

#include <memory>
#include <vector>

namespace Morsel::Contact
{
  /// Share of a particle's slip that friction stops in one step at most, unless
  /// it sticks elastically [1]: a damper that the stable step has to know.
  constexpr double stopped_slip = 0.5;


  /// Penalty contact between particles and one surface. Forces are equal and
  /// opposite; those on the surface are shared between a facet's two nodes
  /// so that neither force nor moment is lost.
  class PlateContact
  {
  public:
    virtual ~PlateContact() = default;

    /// Forces at the positions reference + displacement of the first
    /// @p n_owned particles. Adds to the forces on the surface's nodes, and
    /// the friction heat of a step of length @p time_step [s].
    /// The returned list is valid until the next call.
    /// @param travelled see Particles::travelled
    const std::vector<ParticleForce> &
    compute(const std::vector<dealii::Point<2>> &reference,
            const std::vector<Motion>           &motion,
            unsigned int                         n_owned,
            double                               time_step,
            Surface                             &surface,
            double travelled = MovementWatch::unknown);

    /// The same once more for the same particles, after the surface's nodes
    /// have moved by less than the search margin: in place of the last call.
    const std::vector<ParticleForce> &
    compute_again(const std::vector<Motion> &motion,
                  double                     time_step,
                  Surface                   &surface);

    /// The forces of the last call.
    const std::vector<ParticleForce> &
    last_forces() const
    {
      return forces;
    }

    /// How they change with the surface.
    /// @pre the law is that of a surface that deforms
    virtual const Touches &
    touches() const;

    /// Particles whose centres are within @p distance [m] of the surface, as
    /// they stood at the last compute(); no further than the search margin
    /// (three spacings beyond the range).
    std::vector<unsigned int>
    particles_within(double distance, const Surface &surface) const;

    /// Recoverable energy at the last compute() [J].
    double
    stored_energy() const
    {
      return energy;
    }

    /// Heat of friction so far [J].
    double
    friction_heat() const
    {
      return heat;
    }

    /// Deepest penetration at the last compute() [m].
    double
    deepest_penetration() const
    {
      return penetration;
    }

    /// Mass that resists a slip [kg] where the surface gives way to friction,
    /// too: the particle's own as long as nothing is said.
    void
    set_slipping_mass(const double mass)
    {
      slipping_mass = mass;
    }

    /// @pre the archive knows the names of the particles
    void
    exchange_state(StateArchive &state);

    /// Stiffness of one particle against the surface [N/m]; bounds the step.
    virtual double
    stiffness() const = 0;

  protected:
    PlateContact(const ContactParameters &parameters,
                 const ParticleSide      &side,
                 double                   range);

    /// A particle and the facets near it, [first, last) of facets_near.
    struct Candidate
    {
      unsigned int particle, first, last;
      unsigned int unused;    ///< 0: no byte of a checkpoint is left to chance
      double       clearance; ///< least distance at the search, or less [m]
    };

    /// A particle further than this from all facets does nothing [m].
    virtual double
    influence() const
    {
      return range;
    }

    /// Called before the particles are gone through.
    virtual void
    begin(const Surface &)
    {}

    /// Force on a particle at @p x with velocity @p v.
    virtual dealii::Tensor<1, 2>
    press(const dealii::Point<2>     &x,
          const dealii::Tensor<1, 2> &v,
          const Candidate            &candidate,
          double                      time_step,
          Surface                    &surface) = 0;

    /// Coulomb friction [N] on a particle that moves with @p relative [m/s] to
    /// the surface: never more than what stops it within the step, or what
    /// its spring asks for.
    dealii::Tensor<1, 2>
    friction(unsigned int                particle,
             double                      normal_force,
             const dealii::Tensor<1, 2> &normal,
             const dealii::Tensor<1, 2> &relative,
             double                      time_step);

    /// How friction that sticks grows with the way along the surface [N/m].
    double
    sticking_stiffness(const unsigned int particle,
                       const double       time_step) const
    {
      return parameters.sticks_elastically()
                 ? stiffness_of(particle)
                 : 0.5 * slipping_mass / (time_step * time_step);
    }

    /// Of a particle against the surface [N/m].
    virtual double
    stiffness_of(unsigned int /*particle*/) const
    {
      return stiffness();
    }

    const ContactParameters parameters;
    const ParticleSide      side;
    const double            range; ///< [m], nothing acts beyond it

    std::vector<Candidate> candidates;
    /// Of each candidate by their distances at the search.
    std::vector<unsigned int> facets_near;
    std::vector<double>       distance_of_near; ///< then [m]
    double                    energy = 0., heat = 0., penetration = 0.;

    /// By how far a facet may have come nearer to the particle at hand since
    /// the search [m].
    double
    approach() const
    {
      return approached;
    }

  private:
    const std::vector<ParticleForce> &
    press_all(const std::vector<Motion> &motion,
              double                     time_step,
              Surface                   &surface);

    /// How the surface has moved since the search.
    struct SurfaceMotion
    {
      dealii::Tensor<1, 2> drift;          ///< of all nodes, the mean [m]
      double               farthest  = 0.; ///< of a node [m]
      double               deviation = 0.; ///< of a node from the drift [m]
    };

    SurfaceMotion
    motion_of(const Surface &surface) const;

    template <typename Position>
    void
    search(const Position    &position,
           const unsigned int n_owned,
           const Surface     &surface);

    template <typename Position>
    bool
    search_is_due(const Position    &position,
                  const unsigned int n_owned,
                  const Surface     &surface,
                  double             travelled);

    const double                  margin;
    std::vector<dealii::Point<2>> searched_at, searched_nodes;
    std::vector<dealii::Point<2>> position; ///< of the candidates
    MovementWatch                 watch;
    SurfaceMotion                 moved;
    double                        approached = 0.; ///< see approach()
    std::vector<ParticleForce>    forces;
    double                        heat_before = 0.;
    double                        slipping_mass;

    dealii::Tensor<1, 2>
    spring_friction(unsigned int                particle,
                    double                      most,
                    const dealii::Tensor<1, 2> &normal,
                    const dealii::Tensor<1, 2> &slip,
                    double                      time_step);

    /// How far the springs of particles that stick are stretched, by particle
    /// [m], now and before the present step; empty if there are none.
    std::vector<dealii::Tensor<1, 2>> stretch, stretch_before;
  };


  /// The contact law that the parameters name.
  /// @param edges where the gap of each particle begins, and how much of the
  ///   surface it carries: of no account for the potential
  /// @param deformable whether the surface is that of a body that deforms
  std::unique_ptr<PlateContact>
  make_plate_contact(const ContactParameters &parameters,
                     const ParticleSide      &side,
                     const ParticleEdges     &edges      = {},
                     bool                     deformable = false);
} // namespace Morsel::Contact

#endif
