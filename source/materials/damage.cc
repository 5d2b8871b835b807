#include <morsel/core/errors.h>
#include <morsel/materials/damage.h>

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace Morsel::Materials
{
  namespace
  {
    Driver
    driver_named(const std::string &name)
    {
      return name == "tensile stress"     ? Driver::tensile_stress
             : name == "extension strain" ? Driver::extension_strain
                                          : Driver::modified_von_mises;
    }


    Growth
    growth_named(const std::string &name)
    {
      return name == "Grady-Kipp"         ? Growth::grady_kipp
             : name == "linear softening" ? Growth::linear_softening
                                          : Growth::energy_softening;
    }


    /// Elastic energy of a stress [J/m^3].
    double
    energy_density(const Elasticity &elasticity, const PlaneStrainStress &s)
    {
      const double trace = s.xx + s.yy + s.zz;
      const double squares =
          s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2. * s.xy * s.xy;
      const double nu = elasticity.poissons_ratio;
      return ((1. + nu) * squares - nu * trace * trace) /
             (2. * elasticity.youngs_modulus);
    }
  } // namespace


  DamageLaw::DamageLaw(const DamageParameters &parameters,
                       const Elasticity       &elasticity,
                       const double            strength,
                       const ParticleSize     &particle)
      : driver(driver_named(parameters.driver))
      , growth(growth_named(parameters.growth))
      , softening(parameters.softening == "deviator"
                      ? Softening::deviator
                      : Softening::tensile_principal)
      , compressive_strength(strength)
      , tensile_strength(strength / parameters.strength_ratio)
      , softening_range(parameters.softening_range)
      , weibull_modulus(parameters.weibull_modulus)
  {
    const double nu = elasticity.poissons_ratio;
    if (driver == Driver::extension_strain && nu <= 0.)
      throw InputError(
          "Damage/Driver 'extension strain' needs a Poisson's ratio above 0: "
          "at 0 a compressed block does not extend sideways.");

    if (driver == Driver::extension_strain)
      tensile_strength = strength * nu / (1. - nu);
    if (parameters.fracture_energy > 0.)
      end_times_threshold =
          2. * elasticity.plane_strain_modulus() * parameters.fracture_energy /
          (tensile_strength * tensile_strength * band_width * particle.spacing);

    // What thresholds of scatter are divided by: with energy softening the
    // strength of a block is nearly the mean one, where softening is brittle
    // in compression that of a bundle.
    double b = 1.;
    if (parameters.flaws != "uniform")
      b = growth == Growth::energy_softening
              ? std::tgamma(1. + 1. / weibull_modulus)
              : bundle_peak(weibull_modulus,
                            has_fracture_energy()
                                ? std::max(end_times_threshold, least_range)
                                : softening_range);
    threshold_scale = parameters.threshold_factor / b;

    // Modified von Mises, exact for uniaxial stress in plane strain.
    const double A = 1. - nu + nu * nu;
    von_mises_P    = A * compressive_strength * tensile_strength;
    von_mises_d    = A * (compressive_strength - tensile_strength) / (1. + nu);

    // Lateral strain nu (1 + nu) f_c / E at the compressive strength.
    extension_scale = nu > 0. ? elasticity.youngs_modulus /
                                    (nu * (1. + nu) * compressive_strength)
                              : 0.;

    // alpha^(1/3) of T3-54 with k eps^m = (s / r0)^m / V.
    const double m           = weibull_modulus;
    const double crack_speed = 0.4 * elasticity.wave_speed;
    growth_rate              = (m + 3.) / 3. * crack_speed *
                  std::cbrt(8. * dealii::numbers::PI /
                            ((m + 1.) * (m + 2.) * (m + 3.) * particle.volume));
    flaw_speed = crack_speed /
                 std::cbrt(3. * particle.volume / (4. * dealii::numbers::PI));
  }


  PlaneStrainStress
  soften(const Softening softening, const ElasticResponse &r, const double D)
  {
    const double keep = 1. - D;
    if (softening == Softening::deviator)
      {
        const double mean = r.mean < 0. ? r.mean : keep * r.mean;
        return {keep * r.deviator.xx + mean,
                keep * r.deviator.yy + mean,
                keep * r.deviator.xy,
                keep * r.deviator.zz + mean};
      }

    PlaneStrainStress sigma  = {r.deviator.xx + r.mean,
                                r.deviator.yy + r.mean,
                                r.deviator.xy,
                                r.deviator.zz + r.mean};
    const double      centre = 0.5 * (sigma.xx + sigma.yy);
    const double      half   = 0.5 * (sigma.xx - sigma.yy);
    const double      radius = std::sqrt(half * half + sigma.xy * sigma.xy);
    const double      s1 = centre + radius, s2 = centre - radius;
    const double      t1   = s1 > 0. ? keep * s1 : s1;
    const double      t2   = s2 > 0. ? keep * s2 : s2;
    const double      c2   = radius > 0. ? half / radius : 1.; // cos 2 theta
    const double      s_2  = radius > 0. ? sigma.xy / radius : 0.;
    const double      mean = 0.5 * (t1 + t2), amplitude = 0.5 * (t1 - t2);
    return {mean + amplitude * c2,
            mean - amplitude * c2,
            amplitude * s_2,
            sigma.zz > 0. ? keep * sigma.zz : sigma.zz};
  }


  PlaneStrainStress
  soften(const Softening softening, const PlaneStrainStress &s, const double D)
  {
    ElasticResponse response{};
    response.mean     = (s.xx + s.yy + s.zz) / 3.;
    response.deviator = {
        s.xx - response.mean, s.yy - response.mean, s.xy, s.zz - response.mean};
    return soften(softening, response, D);
  }


  namespace
  {
    /// The deviator softens alone in compression, the strain becomes isochoric
    /// and the stress out of the plane rises, which would strengthen by up to
    /// 9 %. What counts is that of the elastic solid under this stress in the
    /// plane: the strength of a sample stays that of the driver.
    PlaneStrainStress
    softened_stress(const DamageLaw         &law,
                    const Elasticity        &elasticity,
                    const PlaneStrainStress &stress,
                    const double             D)
    {
      PlaneStrainStress sigma = soften(law.softening, stress, D);
      sigma.zz = elasticity.poissons_ratio * (sigma.xx + sigma.yy);
      return sigma;
    }
  } // namespace


  double
  softened_driver(const DamageLaw         &law,
                  const Elasticity        &elasticity,
                  const PlaneStrainStress &stress,
                  const bool               cut_off,
                  const double             D)
  {
    return driver_value(
        law, elasticity, softened_stress(law, elasticity, stress, D), cut_off);
  }


  Softened
  energy_softening(const DamageLaw         &law,
                   const Elasticity        &elasticity,
                   const PlaneStrainStress &stress,
                   const bool               cut_off,
                   const double             r,
                   const double             energy,
                   const Softened          &state,
                   const double             modulus_factor)
  {
    // Both ways of softening are linear in D.
    const PlaneStrainStress whole =
        softened_stress(law, elasticity, stress, 0.);
    const PlaneStrainStress left = softened_stress(law, elasticity, stress, 1.);
    const auto              at   = [&](const double D) -> PlaneStrainStress {
      return {D * left.xx + (1. - D) * whole.xx,
              D * left.yy + (1. - D) * whole.yy,
              D * left.xy + (1. - D) * whole.xy,
              D * left.zz + (1. - D) * whole.zz};
    };
    const auto driver_at = [&](const double D) {
      return driver_value(law, elasticity, at(D), cut_off);
    };
    const double s = driver_at(state.damage);
    if (s <= r * (1. - state.used))
      return state;

    // The strength of this direction is where the softened stress, scaled,
    // meets s = 1.
    const double capacity = law.range_at(r, modulus_factor) * r * r *
                            energy_density(elasticity, at(state.damage)) /
                            (modulus_factor * s * s);
    const double use_per_damage = energy / capacity;
    const auto   excess         = [&](const double D) {
      return driver_at(D) -
             r * (1. - state.used - use_per_damage * (D - state.damage));
    };

    // Convex: Newton's method comes from the left to the first root. Where
    // there is none, more energy is stored than can be used up: it fails.
    double D = state.damage, value = s - r * (1. - state.used);
    for (unsigned int iteration = 0; iteration < 30; ++iteration)
      {
        constexpr double step = 1e-7;
        if (value <= 1e-10 * s)
          return {D, state.used + use_per_damage * (D - state.damage)};
        const double slope = (excess(D + step) - value) / step;
        if (!(slope < 0.) || D - value / slope >= 1.)
          break;
        D -= value / slope;
        value = excess(D);
      }
    return {1., 1.};
  }


  double
  stored_energy(const Softening        softening,
                const Elasticity      &elasticity,
                const ElasticResponse &r,
                const double           D)
  {
    const double keep = 1. - D;
    if (softening == Softening::deviator)
      return keep * r.deviatoric_energy +
             (r.jacobian < 1. ? 1. : keep) * r.volumetric_energy;

    // No potential belongs to this softening: the recoverable energy of the
    // softened stress, linear in the undamaged strain, stands for it.
    const PlaneStrainStress s  = soften(softening, r, D);
    const double            g  = 1. / (2. * elasticity.mu);
    const double            ev = r.mean / (3. * elasticity.bulk);
    return 0.5 *
           (s.xx * (g * r.deviator.xx + ev) + s.yy * (g * r.deviator.yy + ev) +
            2. * s.xy * g * r.deviator.xy + s.zz * (g * r.deviator.zz + ev));
  }


  double
  bundle_peak(const double m, const double range)
  {
    // Mean stress at bundle strain e: integral over the thresholds w of
    // (1 - D(e, w)) e with Weibull density, by the midpoint rule in
    // probability.
    const auto mean_stress_at = [&](const double e) {
      constexpr int n   = 2000;
      double        sum = 0.;
      for (int k = 0; k < n; ++k)
        {
          const double w = std::pow(-std::log1p(-(k + 0.5) / n), 1. / m);
          sum += (1. - linear_softening_damage(e, w, range)) * e;
        }
      return sum / n;
    };

    // Golden section on the single maximum; thresholds are of order one.
    const double golden = 0.5 * (std::sqrt(5.) - 1.);
    double       a = 0.02, b = 3.;
    double       x1 = b - golden * (b - a), x2 = a + golden * (b - a);
    double       f1 = mean_stress_at(x1), f2 = mean_stress_at(x2);
    for (int k = 0; k < 60; ++k)
      if (f1 < f2)
        {
          a  = x1;
          x1 = x2;
          f1 = f2;
          x2 = a + golden * (b - a);
          f2 = mean_stress_at(x2);
        }
      else
        {
          b  = x2;
          x2 = x1;
          f2 = f1;
          x1 = b - golden * (b - a);
          f1 = mean_stress_at(x1);
        }
    return std::max(f1, f2);
  }
} // namespace Morsel::Materials
