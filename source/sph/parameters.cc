#include <morsel/core/kernel.h>
#include <morsel/sph/normalisation.h>
#include <morsel/sph/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::SPH
{
  namespace Patterns = dealii::Patterns;

  void
  SolidParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Formulation",
        formulation,
        "'total Lagrangian' (reference neighbours and gradients, finite "
        "strain) or 'updated Lagrangian' (rate form with the Jaumann rate and "
        "present neighbours).",
        Patterns::Selection("total Lagrangian|updated Lagrangian"));
    prm.add_parameter(
        "Normalisation",
        normalisation,
        "Correction of gradients: 'none' (classical), 'Shepard' (T3-35), 'per "
        "axis' (Johnson and Beissel 1996), 'gradient matrix' (exact for every "
        "linear field), 'conforming' (averaged over Voronoi cells: on every "
        "cloud constant stresses are in balance, too), or 'auto' (gradient "
        "matrix on lattices, conforming on scattered particles of the total "
        "Lagrangian form).",
        Patterns::Selection(normalisation_names));
    prm.add_parameter("Kernel",
                      kernel,
                      "Smoothing kernel: 'cubic B-spline' (T3-33), 'quadratic' "
                      "(T3-34), 'Wendland C2' or 'quintic spline'.",
                      Patterns::Selection(kernel_names));
    prm.add_parameter("Smoothing ratio",
                      smoothing_ratio,
                      "Smoothing length over particle spacing, h/dp [1]; the "
                      "support is 2 h, of the quintic spline 3 h.",
                      Patterns::Double(0.9, 3.));
    prm.add_parameter(
        "Hourglass coefficient",
        hourglass,
        "Stiffness of the residual of the local linear fit, in units of "
        "Young's modulus [1]; 0 switches hourglass control off. The updated "
        "Lagrangian form has none.",
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
        "Artificial stress",
        artificial_stress,
        "epsilon of the artificial stress (T3-37 to T3-43) of the updated "
        "Lagrangian form [1]; 0 switches it off.",
        Patterns::Double(0., 1.));
    prm.add_parameter("Artificial stress exponent",
                      artificial_stress_exponent,
                      "n of (W(r)/W(dp))^n in the artificial stress [1].",
                      Patterns::Double(0.5, 20.));
    prm.add_parameter(
        "CFL factor",
        cfl,
        "Time step over the largest stable one [1]; that is h/c, c the "
        "longitudinal wave speed, less what viscosity and contact take. "
        "Friction that sticks 'damped' caps what is above 0.75.",
        Patterns::Double(1e-3, 1.5));
  }
} // namespace Morsel::SPH
