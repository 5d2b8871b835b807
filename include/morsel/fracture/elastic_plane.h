#ifndef morsel_fracture_elastic_plane_h
#define morsel_fracture_elastic_plane_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace Morsel::Fracture
{
  /// Isotropic linear elasticity in the plane: what the stress, the crack-tip
  /// fields and the stress intensity share.
  class ElasticPlane
  {
  public:
    /// @param youngs_modulus E > 0 [Pa]
    /// @param poissons_ratio 0 <= nu < 0.5 [1]
    /// @param plane_stress   thin plate instead of plane strain
    ElasticPlane(const double youngs_modulus,
                 const double poissons_ratio,
                 const bool   plane_stress = false)
        : poissons_ratio(poissons_ratio)
        , mu(youngs_modulus / (2. * (1. + poissons_ratio)))
        , lambda(plane_stress
                     ? youngs_modulus * poissons_ratio /
                           (1. - poissons_ratio * poissons_ratio)
                     : youngs_modulus * poissons_ratio /
                           ((1. + poissons_ratio) * (1. - 2. * poissons_ratio)))
        , kappa(plane_stress ? (3. - poissons_ratio) / (1. + poissons_ratio)
                             : 3. - 4. * poissons_ratio)
        , effective_modulus(plane_stress
                                ? youngs_modulus
                                : youngs_modulus /
                                      (1. - poissons_ratio * poissons_ratio))
        , plane_stress(plane_stress)
    {}

    /// Stress of a displacement gradient H_ij = du_i/dx_j [Pa] (T3-24).
    dealii::SymmetricTensor<2, 2>
    stress(const dealii::Tensor<2, 2> &gradient) const
    {
      dealii::SymmetricTensor<2, 2> sigma;
      const double pressure = lambda * (gradient[0][0] + gradient[1][1]);
      sigma[0][0]           = pressure + 2. * mu * gradient[0][0];
      sigma[1][1]           = pressure + 2. * mu * gradient[1][1];
      sigma[0][1]           = mu * (gradient[0][1] + gradient[1][0]);
      return sigma;
    }

    /// sigma_zz: nu (sigma_xx + sigma_yy) in plane strain, else 0 [Pa].
    double
    out_of_plane_stress(const dealii::SymmetricTensor<2, 2> &sigma) const
    {
      return plane_stress ? 0. : poissons_ratio * (sigma[0][0] + sigma[1][1]);
    }

    const double poissons_ratio;
    const double mu;     ///< shear modulus [Pa]
    const double lambda; ///< in-plane Lame modulus [Pa]
    const double kappa;  ///< Kolosov's constant [1]
    /// E' of G = (K_I^2 + K_II^2)/E' (T3-13) [Pa].
    const double effective_modulus;
    const bool   plane_stress;
  };
} // namespace Morsel::Fracture

#endif
