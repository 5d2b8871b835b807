#ifndef morsel_contact_parameters_h
#define morsel_contact_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Morsel::Contact
{
  /// How a particle body and a surface press on each other.
  struct ContactParameters
  {
    std::string law = "gap penalty"; ///< "gap penalty" or "potential"
    /// Gap penalty: stiffness in units of (lambda + 2 mu) per spacing [1].
    double stiffness = 1.;
    /// Potential (T4-1): K = kappa E / dp^2 [1] and exponent n [1].
    double potential_kappa    = 0.01;
    double potential_exponent = 4.;
    /// Coulomb friction coefficient [1].
    double friction = 0.5;
    /// What holds a particle that does not slide: "damped" or "elastic".
    std::string stick = "damped";

    bool
    sticks_elastically() const
    {
      return friction > 0. && stick == "elastic";
    }

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Contact

#endif
