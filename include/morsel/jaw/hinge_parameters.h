#ifndef morsel_jaw_hinge_parameters_h
#define morsel_jaw_hinge_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Morsel::Jaw
{
  /// A muscle on a straight line from the skull to the jaw (Hill type, with
  /// a tendon that does not stretch).
  struct MuscleParameters
  {
    std::string      name;
    dealii::Point<2> origin;    ///< on the skull [m]
    dealii::Point<2> insertion; ///< on the jaw as it stands at time 0 [m]
    double           maximal_force = 0.;   ///< of both sides together [N]
    std::string      activation    = "1";  ///< of t, 0 to 1
    double           fibre_length  = 0.03; ///< L_0, optimal [m]
    double           optimal_path  = 0.;   ///< [m], 0: as at time 0
    double           fastest       = 10.;  ///< shortening [L_0/s]

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// A rigid mandible on a hinge.
  struct HingeParameters
  {
    dealii::Point<2> condyle;           ///< [m]
    double           inertia    = 5e-4; ///< about the condyle [kg m^2]
    double           damping    = 0.;   ///< [N m s]
    double           first_spin = 0.;   ///< at time 0, closing [rad/s]
    double           release    = 0.;   ///< held until then [s]

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Jaw

#endif
