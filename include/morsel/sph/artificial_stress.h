#ifndef morsel_sph_artificial_stress_h
#define morsel_sph_artificial_stress_h

#include <morsel/core/records.h>
#include <morsel/materials/elasticity.h>

#include <cmath>

namespace Morsel::SPH
{
  /// -epsilon times the tensile principal part of a stress [Pa]: R_i of Gray,
  /// Monaghan and Swift 2001 (T3-37 to T3-43 with the rotations the right way
  /// round) without the density, which the pair's force divides by.
  inline Symmetric2
  artificial_stress(const Materials::PlaneStrainStress &sigma,
                    const double                        epsilon)
  {
    const double centre = 0.5 * (sigma.xx + sigma.yy);
    const double half   = 0.5 * (sigma.xx - sigma.yy);
    const double radius = std::hypot(half, sigma.xy);
    const double r1     = -epsilon * std::max(centre + radius, 0.);
    const double r2     = -epsilon * std::max(centre - radius, 0.);
    // cos and sin of 2 theta, tan 2 theta = 2 sigma_xy/(sigma_xx - sigma_yy).
    const double c2   = radius > 0. ? half / radius : 1.;
    const double s2   = radius > 0. ? sigma.xy / radius : 0.;
    const double mean = 0.5 * (r1 + r2), amplitude = 0.5 * (r1 - r2);
    return {mean + amplitude * c2, mean - amplitude * c2, amplitude * s2};
  }
} // namespace Morsel::SPH

#endif
