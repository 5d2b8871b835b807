#ifndef morsel_sph_normalisation_h
#define morsel_sph_normalisation_h

#include <morsel/core/records.h>

#include <string>

namespace Morsel::SPH
{
  /// How the gradient sum L_i = sum_j V_j (v_j - v_i) (x) grad_i W_ij is
  /// corrected for neighbours that are missing or lie unevenly.
  enum class Normalisation
  {
    none,            ///< classical SPH
    shepard,         ///< T3-35: over sum_j V_j W_ij
    per_axis,        ///< Johnson and Beissel 1996, the thesis's NSPH
    gradient_matrix, ///< Randles and Libersky 1996: exact for linear fields
    conforming,      ///< not corrected but averaged over Voronoi cells, see
                     ///< conforming_gradient()
  };

  /// The names in parameter files, as a pattern.
  constexpr const char *normalisation_names =
      "auto|none|Shepard|per axis|gradient matrix|conforming";

  inline Normalisation
  normalisation_named(const std::string &name)
  {
    return name == "none"         ? Normalisation::none
           : name == "Shepard"    ? Normalisation::shepard
           : name == "per axis"   ? Normalisation::per_axis
           : name == "conforming" ? Normalisation::conforming
                                  : Normalisation::gradient_matrix;
  }


  /// Sums over the neighbours of a particle of which every normalisation is
  /// made; with a_ij = V_j |W'|/r the kernel's gradient is a_ij x_ij.
  struct NeighbourSums
  {
    Symmetric2 moment; ///< sum_j a_ij x_ij (x) x_ij [1]
    double     kernel; ///< sum_j V_j W_ij, the particle itself included [1]
  };


  /// The matrix B_i with which a gradient sum is multiplied from the right,
  /// in the strain and, by its adjoint, in the force. Per axis it is applied
  /// to gradients of displacement or velocity only: applied to positions it
  /// leaves a deformation at rest. A particle whose neighbours do not span the
  /// plane keeps what the classical sum gives along the directions that it
  /// lacks.
  inline Symmetric2
  gradient_correction(const Normalisation normalisation, const NeighbourSums &s)
  {
    constexpr double least = 1e-3; // of the moment in a full neighbourhood
    const auto over = [](const double x) { return x > least ? 1. / x : 1.; };
    const Symmetric2 &m = s.moment;
    switch (normalisation)
      {
        case Normalisation::none:
          return {1., 1., 0.};
        case Normalisation::shepard:
          return {over(s.kernel), over(s.kernel), 0.};
        case Normalisation::per_axis:
          return {over(m.xx), over(m.yy), 0.};
        default:
          {
            const double determinant = m.xx * m.yy - m.xy * m.xy;
            // Smaller eigenvalue above `least`, without a square root.
            if (determinant > least * (m.xx + m.yy - least) &&
                m.xx + m.yy > 2. * least)
              {
                const double d = 1. / determinant;
                return {d * m.yy, d * m.xx, -d * m.xy};
              }
            return {over(m.xx), over(m.yy), 0.};
          }
      }
  }
} // namespace Morsel::SPH

#endif
