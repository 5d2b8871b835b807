#include <morsel/fracture/hoop_stress.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Fracture
{
  HoopStress
  largest_hoop_stress(const StressIntensity &K)
  {
    const double K_I  = std::max(0., K.mode_I);
    const double K_II = K.mode_II;
    if (K_I == 0. && K_II == 0.)
      return {};
    // K_I sin t + K_II (3 cos t - 1) = 0, in a form that holds at K_II = 0.
    const double t =
        -2. *
        std::atan2(2. * K_II, K_I + std::sqrt(K_I * K_I + 8. * K_II * K_II));
    const double c = std::cos(0.5 * t);
    return {c * (K_I * c * c - 1.5 * K_II * std::sin(t)), t};
  }
} // namespace Morsel::Fracture
