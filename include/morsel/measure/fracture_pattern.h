#ifndef morsel_measure_fracture_pattern_h
#define morsel_measure_fracture_pattern_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <optional>

namespace Morsel::Measure
{
  /// Which way the damage of a body runs.
  struct FracturePattern
  {
    /// Between the direction along which damage is lined up and the axis
    /// of loading [degrees], 0 (axial splitting) to 90.
    double angle = 0.;

    /// How much of the variance of damage straight strips along that direction
    /// explain, more than strips along any direction do on average [1]: 0
    /// where no direction is special, above 0.5 for one straight band.
    double sharpness = 0.;

    /// What strips along the direction explain [1]: 1 if damage is a function
    /// of the place across it alone.
    double explained = 0.;

    double damaged_share = 0.; ///< mean damage [1]
  };


  /// Finds the direction of damaged bands, as a Hough or Radon transform does:
  /// for every direction, degree by degree, the body is cut into strips along
  /// it, and the variance of damage between the strips is set against that
  /// between particles (the correlation ratio). Many parallel bands count as
  /// one does, and of crossing ones the clearer.
  ///
  /// Strips are as wide as three spacings, or as 3 % of the body's smaller
  /// extent where that is more, so that the answer does not hang on the
  /// resolution.
  ///
  /// @param positions of the undeformed body [m]
  /// @param areas of the particles [m^2]
  /// @param damage from 0 to 1
  /// @param axis of loading: 0 = x, 1 = y
  /// @param spacing of the particles [m]
  /// @return nothing where all particles are damaged alike, as in a whole body
  std::optional<FracturePattern>
  fracture_pattern(dealii::ArrayView<const dealii::Point<2>> positions,
                   dealii::ArrayView<const double>           areas,
                   dealii::ArrayView<const double>           damage,
                   unsigned int                              axis,
                   double                                    spacing);
} // namespace Morsel::Measure

#endif
