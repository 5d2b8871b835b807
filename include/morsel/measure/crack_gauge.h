#ifndef morsel_measure_crack_gauge_h
#define morsel_measure_crack_gauge_h

#include <morsel/scene/scene.h>
#include <morsel/sph/deformable_body.h>
#include <morsel/sph/tip_sampling.h>

#include <vector>

namespace Morsel::Measure
{
  /// Stress intensity at the crack tips of a particle body in whatever
  /// formulation, by the interaction integral over its displacements at small
  /// strain. The gradient is the conforming one on the reference
  /// configuration, not the body's own: one ruler for all formulations.
  class CrackGauge
  {
  public:
    /// The body is kept by reference.
    /// @param seed of the scene
    CrackGauge(const Scene::ParticleBody &scene,
               const SPH::DeformableBody &body,
               const unsigned int         seed);

    CrackGauge(const CrackGauge &) = delete;
    CrackGauge &
    operator=(const CrackGauge &) = delete;

    const std::vector<Fracture::CrackTip> &
    get_tips() const
    {
      return tips;
    }

    /// K from the present displacements, a result for each tip. Collective:
    /// every rank works on the displacements of the whole body.
    std::vector<Fracture::TipResult>
    evaluate() const;

  private:
    const SPH::DeformableBody      &body;
    const double                    ring_radius; ///< [m]
    Fracture::ElasticPlane          material;
    std::vector<Fracture::Crack>    cracks;
    std::vector<Fracture::CrackTip> tips;
    SPH::Cloud                      cloud;
    SPH::Visibility                 visibility;
    SPH::ShapeFunctions             shape;
    SPH::DiscreteGradient           gradient;
  };
} // namespace Morsel::Measure

#endif
