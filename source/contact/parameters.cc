#include <morsel/contact/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Contact
{
  namespace Patterns = dealii::Patterns;

  void
  ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Law",
        law,
        "'gap penalty' (pressure from the gap to the surface; no ripple) or "
        "'potential' (the thesis's node potential, T4-1 to T4-3).",
        Patterns::Selection("gap penalty|potential"));
    prm.add_parameter(
        "Stiffness",
        stiffness,
        "Gap penalty: pressure per relative gap, in units of the food's "
        "lambda + 2 mu per particle spacing [1].",
        Patterns::Double(1e-6, 1e4));
    prm.add_parameter(
        "Potential kappa",
        potential_kappa,
        "Potential: K = kappa E / dp^2, the dimensionless kappa [1].",
        Patterns::Double(0., 1e4));
    prm.add_parameter("Potential exponent",
                      potential_exponent,
                      "Potential: exponent n of (W/W(dp))^n [1].",
                      Patterns::Double(1., 32.));
    prm.add_parameter("Friction",
                      friction,
                      "Coulomb friction coefficient [1].",
                      Patterns::Double(0., 10.));
    prm.add_parameter(
        "Stick",
        stick,
        "What holds a particle that does not slide: 'damped' (half of the slip "
        "is stopped in each step, so that it creeps with the time step) or "
        "'elastic' (a spring as stiff as the contact, which holds for good and "
        "does not depend on the step).",
        Patterns::Selection("damped|elastic"));
  }
} // namespace Morsel::Contact
