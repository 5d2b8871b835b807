#ifndef morsel_sph_parameters_h
#define morsel_sph_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Morsel::SPH
{
  /// Numerical choices of one particle body.
  struct SolidParameters
  {
    std::string formulation   = "total Lagrangian";
    std::string normalisation = "auto";
    std::string kernel        = "cubic B-spline";
    /// Smoothing length over particle spacing, h/dp [1].
    double smoothing_ratio = 1.3;
    /// Coefficient of the linear-fit residual hourglass control [1]; 0 = off.
    double hourglass = 0.5;
    /// Artificial viscosity (T3-44), linear and quadratic coefficient [1].
    std::string viscosity       = "auto"; ///< auto|on|off
    double      viscosity_alpha = 1.;
    double      viscosity_beta  = 2.;
    /// Artificial stress (T3-37 to T3-43) [1]; 0 = off.
    double artificial_stress          = 0.;
    double artificial_stress_exponent = 4.;
    /// Time step over the largest stable one [1].
    double cfl = 0.75;

    void
    declare(dealii::ParameterHandler &prm);

    bool
    is_updated() const
    {
      return formulation == "updated Lagrangian";
    }
  };
} // namespace Morsel::SPH

#endif
