#ifndef morsel_sph_applied_conditions_h
#define morsel_sph_applied_conditions_h

#include <morsel/core/expression.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/deformable_body.h>
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
  class AppliedCondition
  {
  public:
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
    void
    set_targets(const Particles &particles, double time, double time_step);

    /// Books work and impulse of the forces now in effect.
    void
    account(const Particles &particles, double half_step, double kick);

    /// Total force now in effect [N].
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

    /// Adds to a list what it prescribes of a component (0: x, 1: y).
    void
    list_constraints(unsigned int component, std::vector<Prescribed *> &list);

    void
    exchange_state(StateArchive &state);

  private:
    struct Loaded
    {
      unsigned int particle;
      double       share; ///< m^2, 1, or kg
      Vector2      force; ///< [N]
    };

    void
    load_particles(const Scene::ParticleBody &body,
                   const DeformableBody      &solid,
                   double                     depth);

    void
    prescribe_particles(const Scene::ParticleBody &body,
                        const DeformableBody      &solid);

    /// The edge's end of a row of particles across a side, from its outermost
    /// one inwards.
    Trace
    trace_at_edge(const std::vector<unsigned int> &row,
                  const std::vector<Vector2>      &surface,
                  const Particles                 &particles,
                  double                           edge) const;

    bool
    concerns(const dealii::Point<2> &x) const;

    const Scene::Condition  condition;
    VectorExpression        value;
    dealii::Tensor<1, 2>    normal; ///< of the side, out of the body
    std::vector<Loaded>     loaded;
    std::vector<Prescribed> prescribed;

    Vector2 total{0., 0.}, given{0., 0.}, impulse_to_come{0., 0.};
    double  done = 0., to_come = 0.;
  };


  /// All conditions of one body.
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
    std::vector<std::unique_ptr<AppliedCondition>> conditions;
    std::vector<unsigned int>                      places;
    std::string                                    name; ///< of the body
    std::unique_ptr<const VelocityConstraints>     constraints;
    double                                         last_step = 0.; ///< [s]
  };
} // namespace Morsel::SPH

#endif
