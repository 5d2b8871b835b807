#ifndef morsel_core_records_h
#define morsel_core_records_h

#include <deal.II/base/tensor.h>

namespace Morsel
{
  /// Displacement [m] and velocity [m/s] of one particle: the record that
  /// pair loops gather from neighbours and ranks exchange.
  struct alignas(32) Motion
  {
    double u_x, u_y, v_x, v_y;
  };


  struct Vector2
  {
    double x, y;
  };


  /// Symmetric 2x2 matrix.
  struct Symmetric2
  {
    double xx, yy, xy;
  };


  /// A plane 2x2 tensor [xx, xy, yx, yy]; kept as four plain doubles because
  /// the pair loops move whole records of it.
  struct Tensor2
  {
    double xx, xy, yx, yy;
  };


  /// A B.
  inline Tensor2
  product(const Tensor2 &A, const Symmetric2 &B)
  {
    return {A.xx * B.xx + A.xy * B.xy,
            A.xx * B.xy + A.xy * B.yy,
            A.yx * B.xx + A.yy * B.xy,
            A.yx * B.xy + A.yy * B.yy};
  }


  /// What contact needs to know of the particles that press on a surface.
  struct ParticleSide
  {
    double spacing;          ///< dp [m]
    double depth;            ///< out of plane [m]
    double mass;             ///< of the lightest particle [kg]
    double youngs_modulus;   ///< [Pa]
    double p_wave_modulus;   ///< lambda + 2 mu [Pa]
    double smoothing_length; ///< h [m], of the potential's kernel
  };


  /// Force on one particle.
  struct ParticleForce
  {
    unsigned int         particle;
    dealii::Tensor<1, 2> force; ///< [N]
  };
} // namespace Morsel

#endif
