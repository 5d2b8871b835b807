#ifndef morsel_jaw_muscle_h
#define morsel_jaw_muscle_h

#include <morsel/core/expression.h>
#include <morsel/jaw/frame.h>
#include <morsel/jaw/hinge_parameters.h>

namespace Morsel::Jaw
{
  /// Factors of a muscle's force, after Thelen (J. Biomech. Eng. 125, 2003,
  /// young adults): active force over length exp(-(l - 1)^2/0.45); passive
  /// force of stretched fibres; Hill's force over velocity (1938), which on
  /// stretching rises to 1.4 with twice the slope. Lengths over the optimal
  /// one, velocities over the fastest, which is 0.25 + 0.75 a of that at full
  /// activation a.
  struct MuscleFactors
  {
    static double
    force_length(double length);

    static double
    passive(double length);

    /// @param shortening > 0 where the fibre gets shorter
    static double
    force_velocity(double shortening);
  };


  /// A closing or opening muscle of a jaw on a hinge.
  class Muscle
  {
  public:
    /// @param condyle about which the jaw turns [m]
    /// @throws InputError if the activation is no expression of t
    Muscle(const MuscleParameters &parameters, const dealii::Point<2> &condyle);

    struct State
    {
      double force;  ///< [N]
      double moment; ///< about the condyle, anticlockwise [N m]
      double length; ///< of the fibre over the optimal one [1]
    };

    /// @param spin of the jaw [rad/s]
    State
    at(double time, double angle, double spin) const;

    /// By which its moment falls at most with the spin of the jaw [N m s]:
    /// fully active, on stretching, the lever arm as long as it can be.
    double
    largest_damping() const;

  private:
    const MuscleParameters parameters;
    const dealii::Point<2> condyle;
    VectorExpression       activation;
    const double           optimal_path;
  };
} // namespace Morsel::Jaw

#endif
