#ifndef morsel_materials_elasticity_h
#define morsel_materials_elasticity_h

#include <morsel/core/records.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Materials
{
  /// Moduli of an isotropic elastic solid, derived once from E, nu and rho.
  struct Elasticity
  {
    double youngs_modulus; ///< E [Pa]
    double poissons_ratio; ///< nu [1]
    double density;        ///< rho_0 [kg/m^3]
    double lambda;         ///< first Lame parameter [Pa]
    double mu;             ///< shear modulus [Pa]
    double bulk;           ///< K = lambda + 2 mu / 3 [Pa]
    double p_wave_modulus; ///< lambda + 2 mu [Pa]
    double wave_speed;     ///< c = sqrt((lambda + 2 mu) / rho) [m/s]

    Elasticity(const double E, const double nu, const double rho)
        : youngs_modulus(E)
        , poissons_ratio(nu)
        , density(rho)
        , lambda(E * nu / ((1. + nu) * (1. - 2. * nu)))
        , mu(E / (2. * (1. + nu)))
        , bulk(lambda + 2. * mu / 3.)
        , p_wave_modulus(lambda + 2. * mu)
        , wave_speed(std::sqrt(p_wave_modulus / rho))
    {}

    /// E' = E/(1 - nu^2), uniaxial stress over strain in plane strain [Pa].
    double
    plane_strain_modulus() const
    {
      return youngs_modulus / (1. - poissons_ratio * poissons_ratio);
    }
  };


  using Morsel::Tensor2;


  /// A symmetric stress in plane strain, with its out-of-plane component.
  struct PlaneStrainStress
  {
    double xx, yy, xy, zz; ///< [Pa]
  };


  inline double
  von_mises(const PlaneStrainStress &s)
  {
    return std::sqrt(0.5 * ((s.xx - s.yy) * (s.xx - s.yy) +
                            (s.yy - s.zz) * (s.yy - s.zz) +
                            (s.zz - s.xx) * (s.zz - s.xx)) +
                     3. * s.xy * s.xy);
  }


  /// Elastic response at one deformation: Kirchhoff-like parts kept apart so
  /// that damage can soften them separately.
  struct ElasticResponse
  {
    double            jacobian; ///< J = det F [1]
    PlaneStrainStress deviator; ///< of the undamaged Cauchy stress [Pa]
    double mean; ///< mean of the undamaged Cauchy stress [Pa], < 0 pressed
    double deviatoric_energy; ///< per reference volume, undamaged [J/m^3]
    double volumetric_energy; ///< per reference volume, undamaged [J/m^3]
  };


  /// Pressure-like mean Cauchy stress of the volumetric energy
  /// K/4 (J^2 - 1 - 2 ln J), stable for every J > 0 [Pa].
  inline double
  mean_stress(const double bulk, const double jacobian)
  {
    return 0.5 * bulk * (jacobian - 1. / jacobian);
  }


  inline double
  volumetric_energy(const double bulk, const double jacobian)
  {
    return 0.25 * bulk * (jacobian * jacobian - 1. - 2. * std::log(jacobian));
  }


  /// J^(-2/3) to round-off; faster than the library's root for J near one.
  inline double
  power_minus_two_thirds(const double J)
  {
    const double e = J - 1.;
    if (!(e * e <= 0.0625))
      {
        const double root = std::cbrt(J);
        return 1. / (root * root);
      }
    // Taylor, then twice y (1 - rho)^(-1/3) with rho = 1 - J^2 y^3.
    double y = 1. + e * (-2. / 3. + e * (5. / 9. - 40. / 81. * e));
    for (unsigned int k = 0; k < 2; ++k)
      {
        const double rho = 1. - (J * J) * (y * y * y);
        y += y * rho * (1. / 3. + rho * (2. / 9. + 14. / 81. * rho));
      }
    return y;
  }


  /// Compressible neo-Hookean solid in plane strain with the energy split
  /// mu/2 (tr(bbar) - 3) + K/4 (J^2 - 1 - 2 ln J), bbar = J^(-2/3) F F^T.
  /// Precondition: det F > 0.
  inline ElasticResponse
  neo_hookean(const Elasticity &material, const Tensor2 &F)
  {
    const double J    = F.xx * F.yy - F.xy * F.yx;
    const double b_xx = F.xx * F.xx + F.xy * F.xy;
    const double b_yy = F.yx * F.yx + F.yy * F.yy;
    const double b_xy = F.xx * F.yx + F.xy * F.yy;

    const double scale  = power_minus_two_thirds(J);
    const double third  = (b_xx + b_yy + 1.) / 3.;
    const double factor = material.mu * scale / J;

    ElasticResponse r;
    r.jacobian = J;
    r.deviator = {factor * (b_xx - third),
                  factor * (b_yy - third),
                  factor * b_xy,
                  factor * (1. - third)};
    r.mean     = mean_stress(material.bulk, J);
    r.deviatoric_energy =
        std::max(0., 1.5 * material.mu * (scale * third - 1.));
    r.volumetric_energy = volumetric_energy(material.bulk, J);
    return r;
  }


  /// Small-strain linear elasticity in plane strain, in the same split form;
  /// Cauchy and first Piola-Kirchhoff stress coincide.
  inline ElasticResponse
  linear_elastic(const Elasticity &material, const Tensor2 &F)
  {
    const double e_xx = F.xx - 1.;
    const double e_yy = F.yy - 1.;
    const double e_xy = 0.5 * (F.xy + F.yx);
    const double tr   = e_xx + e_yy;
    const double d_xx = e_xx - tr / 3., d_yy = e_yy - tr / 3., d_zz = -tr / 3.;

    ElasticResponse r;
    r.jacobian          = 1. + tr;
    r.deviator          = {2. * material.mu * d_xx,
                           2. * material.mu * d_yy,
                           2. * material.mu * e_xy,
                           2. * material.mu * d_zz};
    r.mean              = material.bulk * tr;
    r.deviatoric_energy = material.mu * (d_xx * d_xx + d_yy * d_yy +
                                         d_zz * d_zz + 2. * e_xy * e_xy);
    r.volumetric_energy = 0.5 * material.bulk * tr * tr;
    return r;
  }


  /// First Piola-Kirchhoff stress P = J sigma F^-T.
  inline Tensor2
  piola(const Tensor2 &F, const PlaneStrainStress &sigma)
  {
    // J F^-T is the cofactor matrix of F.
    return {sigma.xx * F.yy - sigma.xy * F.xy,
            -sigma.xx * F.yx + sigma.xy * F.xx,
            sigma.xy * F.yy - sigma.yy * F.xy,
            -sigma.xy * F.yx + sigma.yy * F.xx};
  }
} // namespace Morsel::Materials

#endif
