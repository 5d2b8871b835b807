#ifndef morsel_fracture_hoop_stress_h
#define morsel_fracture_hoop_stress_h

#include <morsel/fracture/interaction_integral.h>

namespace Morsel::Fracture
{
  /// What the criterion of largest hoop stress (Erdogan and Sih 1963) makes of
  /// K_I and K_II: the crack grows once the equivalent K reaches K_Ic.
  struct HoopStress
  {
    double equivalent = 0.; ///< cos(t/2) (K_I cos^2(t/2) - 1.5 K_II sin t)
                            ///< [Pa sqrt(m)]
    double direction = 0.;  ///< t, from the crack's direction to its left [rad]
  };

  /// Without tension ahead (K_I <= 0) the faces touch and K_I is zero; their
  /// friction is not counted.
  HoopStress
  largest_hoop_stress(const StressIntensity &K);
} // namespace Morsel::Fracture

#endif
