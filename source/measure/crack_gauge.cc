#include <morsel/measure/crack_gauge.h>
#include <morsel/measure/whole_body.h>
#include <morsel/sph/body_cloud.h>
#include <morsel/sph/body_cracks.h>

namespace Morsel::Measure
{
  namespace
  {
    /// Support of the fits in spacings, as static plates have it.
    constexpr double smoothing_ratio = 1.3;
  } // namespace


  CrackGauge::CrackGauge(const Scene::ParticleBody &scene,
                         const SPH::DeformableBody &body,
                         const unsigned int         seed)
      : body(body)
      , ring_radius(scene.cracks.ring_radius)
      , material(body.get_material().youngs_modulus,
                 body.get_material().poissons_ratio,
                 false)
      , cracks(SPH::cracks_of(scene))
      , tips(Fracture::collect_tips(cracks))
      , cloud(SPH::body_cloud(scene, seed))
      , visibility(SPH::visibility_in(scene,
                                      cloud.points,
                                      2. * smoothing_ratio * cloud.spacing))
      , shape(
            cloud,
            Kernel(KernelKind::cubic_b_spline, smoothing_ratio * cloud.spacing),
            visibility)
      , gradient(SPH::conforming_gradient(shape))
  {}


  std::vector<Fracture::TipResult>
  CrackGauge::evaluate() const
  {
    std::vector<Motion> of_ranks;
    if (body.ranks())
      of_ranks = of_whole_body(*body.ranks(), body.get_particles().motion);
    const std::vector<Motion> &motion =
        body.ranks() ? of_ranks : body.get_particles().motion;
    SPH::VectorField displacement(cloud.size());
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        const Motion &m = motion[i];
        displacement[i] = dealii::Tensor<1, 2>({m.u_x, m.u_y});
      }
    SPH::TensorField gradients(cloud.size());
    for (unsigned int i = 0; i < cloud.size(); ++i)
      gradients[i] = gradient.gradient(i, displacement);
    return SPH::evaluate_tips(
        {shape, displacement, gradients}, cracks, material, ring_radius, false);
  }
} // namespace Morsel::Measure
