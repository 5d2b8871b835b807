#ifndef morsel_sph_applied_conditions_h
#define morsel_sph_applied_conditions_h

#include <morsel/core/expression.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/deformable_body.h>
#include <morsel/sph/shared_traces.h>
#include <morsel/sph/velocity_constraints.h>

#include <memory>
#include <vector>

namespace Morsel::SPH
{
  inline dealii::Tensor<1, 2>
  as_tensor(const Vector2 &v)
  {
    return dealii::Tensor<1, 2>({v.x, v.y});
  }


  /// One support, load or prescribed motion on the particles of a body, and
  /// the account of what it gives to them.
  ///
  /// Particles stand half a spacing inside of the edge. A traction is given
  /// out in proportion to their surface vectors, so that a constant stress
  /// is in balance with it particle by particle. Motion is prescribed to the
  /// sum over a row of particles with these vectors as weights, the edge's for
  /// linear fields, and its reaction is given out in the same way.
  ///
  /// On several ranks each has its part of forces, impulse and work.
  class AppliedCondition
  {
  public:
    /// Collective. What moves particles needs set_traces(), too.
    AppliedCondition(const Scene::Condition    &condition,
                     const Scene::ParticleBody &body,
                     const DeformableBody      &solid,
                     double                     depth);

    /// Adds forces [N] to the accelerations at time @p time.
    /// @param half_step of the velocities from the last half step to
    ///   @p time [s]: 0 at first.
    void
    add_forces(Particles &particles, double time, double half_step);

    /// Prepares the velocities to prescribe at the half step to come.
    /// @param ranks that share traces, collective then; or null
    void
    set_targets(const Particles       &particles,
                double                 time,
                double                 time_step,
                const ParticleHost<2> *ranks);

    /// Books work and impulse of the forces now in effect.
    void
    account(const Particles &particles, double half_step, double kick);

    /// Force now in effect [N].
    Vector2
    force() const
    {
      return total;
    }

    /// Impulse until the last half step [N s].
    Vector2
    impulse() const
    {
      return given;
    }

    /// Work until the present time [J]; negative of a damping.
    double
    work() const
    {
      return done + 0.5 * to_come;
    }

    bool
    is_damping() const
    {
      return condition.kind == "damping";
    }

    bool
    prescribes_motion() const
    {
      return condition.prescribes_motion();
    }

    /// The traces that it prescribes: of a side all, else those of this rank's
    /// particles.
    TracesOfCondition
    whole_traces() const;

    /// @param own of this rank's particles alone
    /// @param shared_by_ranks see SharedTraces
    void
    set_traces(const std::vector<WholeTrace> &own,
               std::vector<Prescribed>        shared_by_ranks,
               const LocalNumbers            &owned);

    /// Adds to a list what it prescribes of a component (0: x, 1: y), of what
    /// is this rank's own or is shared.
    void
    list_constraints(unsigned int               component,
                     bool                       shared,
                     std::vector<Prescribed *> &list);

    /// Leaves of the shared traces what is of this rank's particles.
    /// @param id of the particles that they go by
    void
    take_part_of_rank(const std::vector<unsigned long long> &id,
                      const LocalNumbers                    &owned);

    void
    exchange_state(StateArchive &state);

  private:
    struct Loaded
    {
      unsigned int particle;
      double       share; ///< m^2, 1, or kg
      Vector2      force; ///< [N]
    };

    /// What a trace needs to know of a particle near a side.
    struct EdgeParticle
    {
      unsigned long long id;
      dealii::Point<2>   reference;  ///< [m]
      Vector2            surface;    ///< [m^2]
      double             negligible; ///< surface [m^2]
    };

    void
    load_particles(const Scene::ParticleBody &body,
                   const DeformableBody      &solid,
                   double                     depth);

    void
    prescribe_particles(const Scene::ParticleBody &body,
                        const DeformableBody      &solid);

    /// Those near the side, of all ranks.
    std::vector<EdgeParticle>
    edge_particles(const Scene::ParticleBody &body,
                   const DeformableBody      &solid) const;

    /// The edge's end of a row of particles across a side, from its outermost
    /// one inwards.
    WholeTrace
    trace_at_edge(unsigned int                             number,
                  const std::vector<const EdgeParticle *> &row,
                  double                                   edge) const;

    bool
    concerns(const dealii::Point<2> &x) const;

    const Scene::Condition  condition;
    VectorExpression        value;
    dealii::Tensor<1, 2>    normal; ///< of the side, out of the body
    std::vector<Loaded>     loaded;
    std::vector<WholeTrace> traces;     ///< until set_traces()
    std::vector<Prescribed> prescribed; ///< the shared ones last
    unsigned int            n_own = 0;  ///< not shared

    Vector2 total{0., 0.}, given{0., 0.}, impulse_to_come{0., 0.};
    double  done = 0., to_come = 0.;
  };


  /// All conditions of one body; whatever is no const method is collective.
  class AppliedConditions
  {
  public:
    AppliedConditions(const Scene::Scene        &scene,
                      const Scene::ParticleBody &body,
                      const DeformableBody      &solid);

    /// Turns the accelerations of the inner forces into those with all
    /// conditions, once a step, after compute_accelerations().
    /// @param time_step that follows [s]
    void
    apply(DeformableBody &solid, double time, double time_step);

    const std::vector<std::unique_ptr<AppliedCondition>> &
    list() const
    {
      return conditions;
    }

    /// The place of each in Scene::conditions.
    const std::vector<unsigned int> &
    numbers() const
    {
      return places;
    }

    void
    exchange_state(StateArchive &state);

  private:
    void
    place_traces(const Particles &particles);

    /// Corrects accelerations so that motions are as prescribed.
    void
    enforce(Particles &particles, double kick) const;

    std::vector<std::unique_ptr<AppliedCondition>> conditions;
    std::vector<unsigned int>                      places;
    std::string                                    name; ///< of the body
    const ParticleHost<2>                         *ranks = nullptr;
    std::unique_ptr<const VelocityConstraints>     constraints, shared;
    double                                         last_step = 0.; ///< [s]
  };


  /// What the conditions of some bodies give on all ranks together [J].
  struct ConditionWork
  {
    double of_loads = 0.; ///< and supports
    double damped   = 0.; ///< taken by damping
  };

  /// Collective.
  ConditionWork
  work_of_conditions(const std::vector<AppliedConditions> &bodies,
                     MPI_Comm                              communicator);


  /// Of each condition on all ranks together [N s]; collective.
  std::vector<dealii::Tensor<1, 2>>
  impulses_of_conditions(const std::vector<AppliedConditions> &bodies,
                         MPI_Comm                              communicator);
} // namespace Morsel::SPH

#endif
