#include <morsel/jaw/hinge_parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Jaw
{
  namespace Patterns = dealii::Patterns;

  void
  MuscleParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Origin", origin, "Where the muscle leaves the skull, 'x, y' [m].");
    prm.add_parameter("Insertion",
                      insertion,
                      "Where it pulls on the jaw, 'x, y' as the jaw stands at "
                      "time 0 [m].");
    prm.add_parameter("Maximal force",
                      maximal_force,
                      "Isometric force at full activation and optimal length, "
                      "of both sides together [N].",
                      Patterns::Double(0.));
    prm.add_parameter("Activation",
                      activation,
                      "Activation as an expression of the time t [s], cut off "
                      "at 0 and 1 [1]: '0.2', 'min(t/0.05, 1)'.");
    prm.add_parameter("Fibre length",
                      fibre_length,
                      "Optimal length L_0 of its fibres [m].",
                      Patterns::Double(1e-4));
    prm.add_parameter("Optimal path",
                      optimal_path,
                      "Distance of origin and insertion at which the fibres "
                      "have their optimal length [m]; 0 takes that at time 0.",
                      Patterns::Double(0.));
    prm.add_parameter("Fastest shortening",
                      fastest,
                      "Speed of shortening without load at full activation "
                      "[L_0/s]; a quarter of it at none.",
                      Patterns::Double(1e-3));
  }


  void
  HingeParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Condyle",
                      condyle,
                      "Axis 'x, y' about which the jaw turns [m]. Bodies ride "
                      "on it by 'Motion/Kind' = 'jaw'; anticlockwise closes.");
    prm.add_parameter("Moment of inertia",
                      inertia,
                      "Of the jaw about the condyle [kg m^2]: 0.2 kg at 50 mm "
                      "are 5e-4.",
                      Patterns::Double(0.));
    prm.add_parameter("Damping",
                      damping,
                      "Moment of tissues over the angular velocity [N m s].",
                      Patterns::Double(0.));
    prm.add_parameter("Initial speed",
                      first_spin,
                      "Angular velocity at time 0, anticlockwise [rad/s].");
    prm.add_parameter("Release time",
                      release,
                      "Until then the jaw is held against its muscles, as by a "
                      "bite on a rod that is then pulled away [s].",
                      Patterns::Double(0.));
  }
} // namespace Morsel::Jaw
