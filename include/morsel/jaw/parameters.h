#ifndef morsel_jaw_parameters_h
#define morsel_jaw_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>

namespace Morsel::Jaw
{
  /// Whether and how a plate or tooth deforms under the food.
  struct DeformationParameters
  {
    bool        elastic  = false;  ///< of the kind 'elastic', not 'rigid'
    std::string response = "auto"; ///< or rigid, quasi-static, dynamic

    double density            = 0.; ///< [kg/m^3]
    double youngs_modulus     = 0.; ///< [Pa]
    double poissons_ratio     = 0.; ///< [1]
    double fracture_toughness = 0.; ///< K_Ic, of a cracked body [Pa sqrt(m)]

    double           cell_size       = 0.; ///< [m], 0: by rule
    unsigned int     degree          = 1;  ///< of the displacement
    unsigned int     tip_refinements = 0;  ///< halvings of cells about tips
    std::string      held_sides;           ///< that follow the motion
    double           tolerance = 0.01;     ///< of 'auto' [1]
    double           beta      = 0.;       ///< Newmark's, of 'dynamic' [1]
    dealii::Point<2> initial_velocity;     ///< of a body not held [m/s]

    /// The sections "Deformation" and "Material".
    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Jaw

#endif
