#ifndef morsel_sph_pair_loops_h
#define morsel_sph_pair_loops_h

#include <morsel/materials/damage.h>
#include <morsel/sph/bonds.h>
#include <morsel/sph/particles.h>

#include <array>

namespace Morsel::SPH
{
  /// What the kernels of pair_kernels.h work on; valid until a field of
  /// @p particles or @p bonds is allocated anew.
  BondedArrays
  bonded_arrays(Particles &particles, Bonds &bonds);


  /// What particle @p i of a conforming form has of its uncut bonds: the
  /// residual's fit, the sum of its gradient's weights and, where allocated,
  /// the deficit. Precondition: these bonds span the plane.
  void
  renew_conforming(Particles &particles, const Bonds &bonds, unsigned int i);

  /// H_i at the present displacements [1], as the kernels form it.
  /// @param ahead the coming leapfrog step [s], with the accelerations that
  ///   stand: at the displacements after it; 0: now
  Materials::Tensor2
  displacement_gradient(const Particles &particles,
                        const Bonds     &bonds,
                        unsigned int     i,
                        double           ahead = 0.);

  /// What the strain of a particle is, and what no linear field explains.
  struct LocalStrain
  {
    Materials::Tensor2 gradient; ///< H_i [1]
    double             residual; ///< see fit_residual() [m^3]
  };

  /// Both now (with the gradient that is stored) and at the end of the coming
  /// leapfrog step of length @p step [s], in one sweep.
  std::array<LocalStrain, 2>
  strain_over_step(const Particles &particles,
                   const Bonds     &bonds,
                   unsigned int     i,
                   double           step);

  /// The same of the present velocities: dH_i/dt [1/s].
  Materials::Tensor2
  rate_of_gradient(const Particles &particles,
                   const Bonds     &bonds,
                   unsigned int     i);

  /// Elastic response of particle @p i at its present gradient.
  Materials::ElasticResponse
  response_at(const Particles             &particles,
              const Materials::Elasticity &material,
              bool                         linear_law,
              unsigned int                 i);

  /// Elastic response to a displacement gradient H [1].
  Materials::ElasticResponse
  response_to(const Materials::Tensor2    &H,
              const Materials::Elasticity &material,
              bool                         linear_law);

  /// Energy of the residual of the local linear fit of particle @p i at unit
  /// hourglass stiffness [m^3]; times (alpha E (1 - D)) it is in joules.
  /// @param ahead as for displacement_gradient()
  double
  fit_residual(const Particles &particles,
               const Bonds     &bonds,
               unsigned int     i,
               double           ahead = 0.);
} // namespace Morsel::SPH

#endif
