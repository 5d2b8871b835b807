#ifndef morsel_fracture_energy_release_h
#define morsel_fracture_energy_release_h

#include <morsel/fracture/interaction_integral.h>

#include <array>

namespace Morsel::Fracture
{
  /// What is held while a crack grows; it decides the sign of T3-47.
  enum class HeldQuantity
  {
    traction,    ///< G = +dU/da
    displacement ///< G = -dU/da
  };


  /// Energy release rate [J/m^2] by the one-sided difference of T3-47:
  /// dU/da ~ (-3/2 U(a) + 2 U(a + da) - 1/2 U(a + 2 da))/da.
  /// Its own bias with exact energies is known on the edge crack M1 (K at
  /// 0.952/0.994/0.9985/0.9996 of the truth for da = 0.5/0.2/0.1/0.05 mm
  /// at a = 1 mm); an error of U is amplified by about 16 mm/da.
  /// Where several tips grow together it is the sum over the tips.
  /// @param energies U at a, a + da, a + 2 da [J per metre of depth]
  /// @param growth   da > 0 [m]
  double
  energy_difference(const std::array<double, 3> &energies,
                    const double                 growth,
                    const HeldQuantity           held);


  /// sqrt(E' G) [Pa sqrt(m)], 0 where noise made G negative.
  double
  stress_intensity_of_energy(const double energy_release_rate,
                             const double effective_modulus);


  /// The thesis's mixed-mode recipe (T3-15), an approximation under that
  /// name: G_1 = (K_I^2 + K_II^2)/E' ahead, G_2 = -2 K_I K_II/E' across,
  /// solved for K_I >= |K_II|. G_2 is the second component of the J vector
  /// (Hellen and Blackburn 1975), not what a really kinked crack releases.
  StressIntensity
  two_direction_recipe(const double release_ahead,
                       const double release_across,
                       const double effective_modulus);
} // namespace Morsel::Fracture

#endif
