#ifndef morsel_sph_updated_loops_h
#define morsel_sph_updated_loops_h

#include <morsel/core/kernel.h>
#include <morsel/core/records.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/normalisation.h>
#include <morsel/sph/pair_kernels.h>

#include <vector>

namespace Morsel::SPH
{
  /// Constants of the updated Lagrangian pair loops.
  struct UpdatedConstants
  {
    KernelKind    kernel;
    Normalisation normalisation;
    double        h;                 ///< smoothing length [m]
    double        viscosity_alpha_c; ///< alpha times the wave speed [m/s]
    double        viscosity_beta;
    double        closeness_scale; ///< 1/W(dp) [m^2]
    double        closeness_exponent;
    bool          viscosity, artificial_stress;
  };


  /// Plain addresses of what the loops read and write. Entries of pairs stand
  /// as in the list of neighbours; those of particles in its rows.
  struct UpdatedArrays
  {
    const NeighbourList *neighbours;
    const Motion        *place;          ///< position and velocity at one time
    const double        *area;           ///< V_j per depth [m^2]
    const double        *mass;           ///< [kg]
    const double        *mass_per_depth; ///< [kg/m]
    const double        *density;

    // Filled by correct_geometry(), read by sum_forces().
    double     *weight; ///< |W'|/r [1/m^4]
    Vector2    *offset; ///< x_j - x_i [m]
    double     *closeness;
    Symmetric2 *shape; ///< B_i [1]

    const PairStress *corrected_stress;  ///< sigma_i B_i [Pa]
    const Symmetric2 *artificial_stress; ///< R_i [Pa]
    Vector2          *acceleration;
    double           *viscous_heat, *artificial_heat; ///< [J], added to
  };


  /// L_i at the given places [1/s], each with its own normalisation.
  void
  sum_velocity_gradients(const UpdatedArrays    &arrays,
                         const UpdatedConstants &constants,
                         Tensor2                *gradients);


  /// Weights, offsets and B_i at the given places.
  void
  correct_geometry(const UpdatedArrays    &arrays,
                   const UpdatedConstants &constants);


  /// dv_i/dt = (1/rho_i) sum_j V_j (sigma_i B_i + sigma_j B_j +
  /// f_ij^n (R_i + R_j)) grad_i W_ij - sum_j m_j Pi_ij grad_i W_ij (T3-36 in
  /// the form adjoint to the strain rate): opposite for i and j.
  void
  sum_forces(const UpdatedArrays    &arrays,
             const UpdatedConstants &constants,
             double                  time_step);
} // namespace Morsel::SPH

#endif
