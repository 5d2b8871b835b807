#include <morsel/sph/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::SPH
{
  namespace Patterns = dealii::Patterns;

  void
  SolidParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Kernel",
                      kernel,
                      "Smoothing kernel: 'cubic B-spline' or 'Wendland C2'.",
                      Patterns::Selection("cubic B-spline|Wendland C2"));
    prm.add_parameter(
        "Smoothing ratio",
        smoothing_ratio,
        "Smoothing length over particle spacing, h/dp [1]; the support is 2 h.",
        Patterns::Double(0.9, 3.));
    prm.add_parameter(
        "Hourglass coefficient",
        hourglass,
        "Stiffness of the residual of the local linear fit, in units of "
        "Young's modulus [1]; 0 switches hourglass control off.",
        Patterns::Double(0., 100.));
    prm.add_parameter(
        "Viscosity",
        viscosity,
        "Artificial viscosity (T3-44): 'on', 'off', or 'auto' (on where the "
        "solid can fail).",
        Patterns::Selection("auto|on|off"));
    prm.add_parameter("Viscosity alpha",
                      viscosity_alpha,
                      "Linear coefficient of the artificial viscosity [1].",
                      Patterns::Double(0., 10.));
    prm.add_parameter("Viscosity beta",
                      viscosity_beta,
                      "Quadratic coefficient of the artificial viscosity [1].",
                      Patterns::Double(0., 10.));
    prm.add_parameter(
        "CFL factor",
        cfl,
        "Time step over the largest stable one [1]; that is h/c, c the "
        "longitudinal wave speed, less what viscosity and contact take.",
        Patterns::Double(1e-3, 1.5));
  }
} // namespace Morsel::SPH
