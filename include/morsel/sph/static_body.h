#ifndef morsel_sph_static_body_h
#define morsel_sph_static_body_h

#include <morsel/scene/scene.h>
#include <morsel/sph/body_cloud.h>
#include <morsel/sph/equilibrium.h>

#include <vector>

namespace Morsel::SPH
{
  /// What a condition of the scene came to.
  struct ConditionForce
  {
    unsigned int         condition; ///< its place in the scene
    dealii::Tensor<1, 2> force;     ///< on the body [N]
  };


  struct StaticBodyResults : EquilibriumResults
  {
    Evenness                    cells;
    unsigned int                n_free_motions = 0;
    std::vector<ConditionForce> forces;
    /// At the tips of the body's cracks.
    std::vector<Fracture::TipResult> tips;
  };


  /// A particle body of a scene in equilibrium under its conditions.
  ///
  /// Tractions, pressures, clamps, rollers and displacements of a side act on
  /// the boundary itself (StaticSolid). A force on a side is spread evenly over
  /// it; in a box or everywhere, forces and accelerations are given to the
  /// particles by their volumes, and clamps and displacements hold the
  /// particles. A line of sight that leaves a body with recesses or holes
  /// joins no particles. Rigid motions that nothing holds are pinned where the
  /// loads are in balance.
  class StaticBody : public Equilibrium
  {
  public:
    /// @throws InputError, one sentence, if the body cannot be filled, or for
    ///   conditions that concern nothing or leave it free to move
    StaticBody(const Scene::Scene &scene, const Scene::ParticleBody &body);

    const StaticBodyResults &
    run();

    /// Displacement and gradient at a place as the particle next to it sees
    /// them: that may be on the boundary.
    Fracture::DisplacementSample
    observe(const dealii::Point<2> &place) const;

    const StaticBodyResults &
    get_results() const
    {
      return results;
    }

    const Scene::ParticleBody &
    get_body() const
    {
      return body;
    }

  private:
    /// Supports of a condition, [begin, end) of the solid's.
    struct Support
    {
      unsigned int condition, begin, end;
    };

    struct TimedCloud
    {
      TimedCloud(const Scene::ParticleBody &body, const unsigned int seed);

      Cloud  cloud;
      double seconds; ///< that filling took [s]
    };

    StaticBody(const Scene::Scene        &scene,
               const Scene::ParticleBody &body,
               const TimedCloud          &filled);

    void
    apply_conditions(StaticSolid &solid);

    /// @return the total force [N/m]
    dealii::Tensor<1, 2>
    load_side(const Scene::Condition &condition, StaticSolid &solid) const;
    dealii::Tensor<1, 2>
    load_particles(const Scene::Condition &condition, StaticSolid &solid) const;
    void
    support_side(const Scene::Condition &condition, StaticSolid &solid) const;
    void
    support_particles(const Scene::Condition &condition,
                      StaticSolid            &solid) const;

    bool
    concerns(const Scene::Condition &condition,
             const dealii::Point<2> &x) const;

    /// The facets on the condition's side, cut off at its box.
    /// @param use called with the owner and the facet
    template <typename Use>
    void
    for_each_facet(const Scene::Condition &condition, const Use &use) const;

    const Scene::Scene        &scene;
    const Scene::ParticleBody &body;
    Scene::Outline             outline;
    std::vector<Support>       supports;
    StaticBodyResults          results;
  };
} // namespace Morsel::SPH

#endif
