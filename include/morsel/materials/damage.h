#ifndef morsel_materials_damage_h
#define morsel_materials_damage_h

#include <morsel/materials/elasticity.h>
#include <morsel/materials/parameters.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Materials
{
  enum class Driver
  {
    tensile_stress,
    extension_strain,
    modified_von_mises
  };

  enum class Growth
  {
    linear_softening,
    energy_softening,
    grady_kipp
  };

  enum class Softening
  {
    deviator,
    tensile_principal
  };


  /// What a particle stands for.
  struct ParticleSize
  {
    double volume;  ///< [m^3]
    double spacing; ///< [m]
  };


  /// A damage law ready for use: names turned into choices, derived constants
  /// computed once. All drivers are normalised: s = 1 at the prescribed
  /// strength of a homogeneous solid.
  struct DamageLaw
  {
    Driver    driver;
    Growth    growth;
    Softening softening;
    double    compressive_strength; ///< f_c [Pa]
    double    tensile_strength;     ///< f_t [Pa]
    double    softening_range;      ///< threshold multiple where D = 1 [1]
    /// Product of the threshold and of the driver value where D = 1, R r^2 =
    /// 2 E' G_c/(f_t^2 w) (crack band, doc/theory.md, section 3); 0 where the
    /// softening range holds [1].
    double end_times_threshold = 0.;
    /// Grady-Kipp rate of D^(1/3) at s equal to the scale r0 [1/s].
    double growth_rate;
    double weibull_modulus;
    double threshold_scale; ///< r0 of r_i = r0 w_i [1]
    /// Rate of D^(1/3) per active flaw of Benz and Asphaug (1995): crack
    /// speed over the radius of a ball of the particle's volume [1/s].
    double flaw_speed;

    // Constants of the closed-form drivers.
    double von_mises_d, von_mises_P, extension_scale;

    /// A crack dissipates over this many spacings (measured, see
    /// doc/theory.md, section 3).
    static constexpr double band_width = 2.6;
    /// Softening as steep as it may be: D = 1 at this multiple of r.
    static constexpr double least_range = 1.01;

    /// @param particle its volume enters the rates of Grady-Kipp growth alone,
    /// its spacing the softening with a fracture energy.
    /// Throws InputError where the combination makes no sense.
    DamageLaw(const DamageParameters &parameters,
              const Elasticity       &elasticity,
              double                  compressive_strength,
              const ParticleSize     &particle);

    bool
    has_fracture_energy() const
    {
      return end_times_threshold > 0.;
    }

    /// Multiple of the threshold @p r where D = 1 [1]. With a fracture energy
    /// G_c (crack band, Bazant and Oh 1983) the area r f_t (range r f_t)/(2 E')
    /// under the curve in tension, times the width of the band, is G_c for
    /// every threshold and spacing.
    /// @param modulus_factor of a grain whose elastic moduli are so many times
    ///   the body's [1]: E' of the area is its own.
    double
    range_at(const double r, const double modulus_factor = 1.) const
    {
      return has_fracture_energy()
                 ? std::max(least_range,
                            modulus_factor * end_times_threshold / (r * r))
                 : softening_range;
    }
  };


  /// Larger in-plane principal value of a symmetric plane tensor.
  inline double
  largest_principal(const double xx, const double yy, const double xy)
  {
    const double half_difference = 0.5 * (xx - yy);
    return 0.5 * (xx + yy) +
           std::sqrt(half_difference * half_difference + xy * xy);
  }


  /// Normalised driver s(sigma) [1] of an undamaged Cauchy stress; convex and
  /// homogeneous of degree one. @p cut_off adds the tensile cut-off
  /// sigma_1/f_t to the modified von Mises driver (away from loaded faces).
  inline double
  driver_value(const DamageLaw         &law,
               const Elasticity        &elasticity,
               const PlaneStrainStress &sigma,
               const bool               cut_off)
  {
    switch (law.driver)
      {
        case Driver::tensile_stress: // T3-55, scaled to f_t
          return std::max(
                     0.,
                     std::max(largest_principal(sigma.xx, sigma.yy, sigma.xy),
                              sigma.zz)) /
                 law.tensile_strength;
        case Driver::extension_strain:
          {
            // Largest principal strain from Hooke's law; zz cannot extend.
            const double sigma_1 =
                largest_principal(sigma.xx, sigma.yy, sigma.xy);
            const double sigma_2 = sigma.xx + sigma.yy - sigma_1;
            const double strain =
                (sigma_1 - elasticity.poissons_ratio * (sigma_2 + sigma.zz)) /
                elasticity.youngs_modulus;
            return std::max(0., strain) * law.extension_scale;
          }
        default:
          {
            const double I1   = sigma.xx + sigma.yy + sigma.zz;
            const double mean = I1 / 3.;
            const double dx = sigma.xx - mean, dy = sigma.yy - mean,
                         dz = sigma.zz - mean;
            const double J2 =
                0.5 * (dx * dx + dy * dy + dz * dz) + sigma.xy * sigma.xy;
            const double dI1 = law.von_mises_d * I1;
            const double s =
                (dI1 + std::sqrt(dI1 * dI1 + 12. * law.von_mises_P * J2)) /
                (2. * law.von_mises_P);
            if (!cut_off)
              return s;
            const double sigma_1 = std::max(
                largest_principal(sigma.xx, sigma.yy, sigma.xy), sigma.zz);
            return std::max(s, sigma_1 / law.tensile_strength);
          }
      }
  }


  /// Damage of linear softening at the largest driver value @p s seen so far:
  /// the stress falls linearly from the threshold r to zero at range * r.
  inline double
  linear_softening_damage(const double s, const double r, const double range)
  {
    if (s <= r)
      return 0.;
    if (s >= range * r)
      return 1.;
    return 1. - (range * r - s) / ((range - 1.) * s);
  }


  /// How far a particle has softened.
  struct Softened
  {
    double damage; ///< D [1]
    double used;   ///< kappa, share of what it can dissipate [1]
  };


  /// Driver [1] of what damage @p D leaves of an undamaged Cauchy stress.
  double
  softened_driver(const DamageLaw         &law,
                  const Elasticity        &elasticity,
                  const PlaneStrainStress &stress,
                  bool                     cut_off,
                  double                   D);


  /// Growth of damage that keeps the driver of the *softened* stress within
  /// r (1 - kappa), where kappa is the energy dissipated so far over
  /// g = R r^2 (f^2/(2 E')), f being the strength in the direction of this
  /// stress: in tension and in compression the stress falls linearly from
  /// r f to zero at the strain R r f/E'. Returns @p state where it holds.
  /// @param stress undamaged Cauchy stress that drives
  /// @param energy [J/m^3] stored undamaged that D takes away
  /// @param modulus_factor as in DamageLaw::range_at()
  Softened
  energy_softening(const DamageLaw         &law,
                   const Elasticity        &elasticity,
                   const PlaneStrainStress &stress,
                   bool                     cut_off,
                   double                   r,
                   double                   energy,
                   const Softened          &state,
                   double                   modulus_factor = 1.);


  /// Grady-Kipp growth (T3-53, T3-54) of D over @p dt while s exceeds r.
  inline double
  grady_kipp_damage(const DamageLaw &law,
                    const double     D,
                    const double     s,
                    const double     r,
                    const double     dt)
  {
    if (s <= r)
      return D;
    const double rate = law.growth_rate * std::pow(s / law.threshold_scale,
                                                   law.weibull_modulus / 3.);
    const double root = std::cbrt(D) + rate * dt;
    return std::min(1., root * root * root);
  }


  /// Growth of D over @p dt with @p active of @p count explicit flaws (Benz
  /// and Asphaug 1995): d(D^(1/3))/dt = active c_g/R, up to D = active/count.
  inline double
  explicit_flaw_damage(const DamageLaw   &law,
                       const double       D,
                       const unsigned int active,
                       const unsigned int count,
                       const double       dt)
  {
    const double root = std::cbrt(D) + active * law.flaw_speed * dt;
    return std::max(
        D, std::min(root * root * root, active / static_cast<double>(count)));
  }


  /// Cauchy stress after softening. 'deviator': (1 - D) on the deviator and
  /// on tensile mean stress; 'tensile principal' (T3-56): (1 - D) on the
  /// tensile principal stresses.
  PlaneStrainStress
  soften(Softening softening, const ElasticResponse &response, double D);


  /// The same of a given undamaged Cauchy stress.
  PlaneStrainStress
  soften(Softening softening, const PlaneStrainStress &stress, double D);


  /// Stored energy per reference volume after softening [J/m^3]. For
  /// 'deviator' the stress of soften() is its exact derivative.
  double
  stored_energy(Softening              softening,
                const Elasticity      &elasticity,
                const ElasticResponse &response,
                double                 D);


  /// Peak of the mean stress of an equal-strain bundle of softening elements
  /// with Weibull(m, 1) thresholds, relative to an element of threshold 1:
  /// the b of the threshold rule r_i = c w_i / b. Tends to the brittle value
  /// (m e)^(-1/m) for @p range towards 1.
  double
  bundle_peak(double weibull_modulus, double range);
} // namespace Morsel::Materials

#endif
