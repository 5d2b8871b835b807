#include <morsel/fracture/energy_release.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Fracture
{
  double
  energy_difference(const std::array<double, 3> &energies,
                    const double                 growth,
                    const HeldQuantity           held)
  {
    Assert(growth > 0., dealii::ExcMessage("The crack must grow."));
    const double slope =
        (-1.5 * energies[0] + 2. * energies[1] - 0.5 * energies[2]) / growth;
    return held == HeldQuantity::traction ? slope : -slope;
  }


  double
  stress_intensity_of_energy(const double energy_release_rate,
                             const double effective_modulus)
  {
    return std::sqrt(std::max(0., energy_release_rate * effective_modulus));
  }


  StressIntensity
  two_direction_recipe(const double release_ahead,
                       const double release_across,
                       const double effective_modulus)
  {
    // E'(G_1 -+ G_2) = (K_I +- K_II)^2.
    const double sum = stress_intensity_of_energy(
        release_ahead - release_across, effective_modulus);
    const double difference = stress_intensity_of_energy(
        release_ahead + release_across, effective_modulus);
    return {0.5 * (sum + difference), 0.5 * (sum - difference)};
  }
} // namespace Morsel::Fracture
