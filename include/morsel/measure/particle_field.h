#ifndef morsel_measure_particle_field_h
#define morsel_measure_particle_field_h

#include <morsel/scene/scene.h>
#include <morsel/sph/deformable_body.h>

/// All of these are collective.
namespace Morsel::Measure
{
  /// Smallest distance of two particles now, in spacings [1]; 2 where it is
  /// more than that.
  double
  smallest_spacing(const SPH::DeformableBody &body);


  /// Roughness of a stress field: root mean square of what a particle differs
  /// from the mean of its four neighbours in the lattice, over that of the
  /// whole stress in the plane [1]. Only for particles on a lattice.
  struct Noise
  {
    double xx, yy;
  };

  Noise
  stress_noise(const SPH::DeformableBody &body,
               const Scene::ParticleBody &shape);


  /// Mean stress along the axes and its standard deviation over the particles
  /// with a full support [Pa].
  struct InteriorStress
  {
    unsigned int count   = 0; ///< of such particles
    double       mean_xx = 0., mean_yy = 0.;
    double       deviation_xx = 0., deviation_yy = 0.;
  };

  /// @param support radius of the kernel [m]
  InteriorStress
  interior_stress(const SPH::DeformableBody &body,
                  const Scene::ParticleBody &shape,
                  double                     support);


  /// Root mean square of what a particle's velocity differs from the mean of
  /// its four neighbours in the lattice [m/s]: smooth motion does not count.
  double
  velocity_roughness(const SPH::DeformableBody &body,
                     const Scene::ParticleBody &shape);


  /// Largest error of the velocity gradient's symmetric part [1/s], by where
  /// particles stand: with a full support, in the outermost row with a full
  /// support along it, and in the corners.
  struct GradientErrors
  {
    double interior, edge, corner;
  };

  GradientErrors
  strain_rate_errors(const SPH::DeformableBody &body,
                     const Scene::ParticleBody &shape,
                     double                     support,
                     const Tensor2             &expected);
} // namespace Morsel::Measure

#endif
