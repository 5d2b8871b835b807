#ifndef morsel_sph_pair_loops_h
#define morsel_sph_pair_loops_h

#include <morsel/materials/damage.h>
#include <morsel/sph/bonds.h>
#include <morsel/sph/particles.h>

namespace Morsel::SPH
{
  /// Constants that the two hot loops need, gathered once per run.
  struct LoopConstants
  {
    Materials::Elasticity material;
    Materials::Softening  softening;
    double                viscosity_alpha; ///< T3-44 [1]
    double                viscosity_beta;  ///< T3-44 [1]
    double                smoothing_length;
  };


  /// First loop, over the owned particles [begin, end): displacement
  /// gradient H_i, stress, and the record that the second loop gathers.
  using StrainLoop = void (*)(Particles           &particles,
                              const Bonds         &bonds,
                              const LoopConstants &constants,
                              unsigned int         begin,
                              unsigned int         end);

  /// Second loop: acceleration of the owned particles [begin, end) by stress,
  /// hourglass control and artificial viscosity. Overwrites acceleration;
  /// adds the viscous heat of a step of length @p time_step.
  using ForceLoop = void (*)(Particles           &particles,
                             const Bonds         &bonds,
                             const LoopConstants &constants,
                             double               time_step,
                             unsigned int         begin,
                             unsigned int         end);

  /// The instantiation for a solid; nothing is decided inside the loops.
  StrainLoop
  choose_strain_loop(bool linear_law, bool damage);

  ForceLoop
  choose_force_loop(bool viscosity);


  /// H_i = (sum_j a_ij u_ij (x) X_ij) B_i [1].
  Materials::Tensor2
  displacement_gradient(const Particles &particles,
                        const Bonds     &bonds,
                        unsigned int     i);

  /// Elastic response of particle @p i at its present gradient.
  Materials::ElasticResponse
  response_at(const Particles             &particles,
              const Materials::Elasticity &material,
              bool                         linear_law,
              unsigned int                 i);

  /// Energy of the residual of the local linear fit of particle @p i at unit
  /// hourglass stiffness [m^3]; times (alpha E (1 - D)) it is in joules.
  double
  fit_residual(const Particles &particles, const Bonds &bonds, unsigned int i);
} // namespace Morsel::SPH

#endif
