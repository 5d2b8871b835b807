#ifndef morsel_sph_highest_frequency_h
#define morsel_sph_highest_frequency_h

#include <morsel/core/records.h>

#include <functional>
#include <vector>

namespace Morsel::SPH
{
  /// Displacements to start from, the same for a particle on any number of
  /// ranks.
  std::vector<Vector2>
  random_field(const std::vector<unsigned long long> &ids);


  /// Square of the highest frequency [1/s^2] of a body whose accelerations
  /// answer linearly to its displacements: the largest eigenvalue of
  /// M^-1 K by Lanczos' method, plus the residual of its
  /// eigenvector (within a few times 1e-3 of it, from above).
  /// @param acceleration accelerations at the given displacements
  /// @param start        random_field() of the particles
  /// @param mass         of every particle [kg]
  /// @param tolerance    residual over the eigenvalue that is good enough [1]
  /// @param sum          over all ranks, where particles live on several
  double
  square_of_highest_frequency(
      const std::function<void(const std::vector<Vector2> &displacements,
                               std::vector<Vector2>       &accelerations)>
                                          &acceleration,
      std::vector<Vector2>                 start,
      const std::vector<double>           &mass,
      double                               tolerance = 2e-3,
      const std::function<double(double)> &sum       = {});
} // namespace Morsel::SPH

#endif
