#include <morsel/core/suggestions.h>
#include <morsel/materials/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Materials
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /// What an open entry stands for.
    std::string
    else_default(const std::string &open, const double value)
    {
      return " " + open + ": the catalogue's, else " + number_text(value) + ".";
    }
  } // namespace

  void
  MaterialParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Name",
        name,
        "Entry of the catalogue of foods and rocks, or 'inline' if every value "
        "is given here. A value given here goes before the catalogue's.");
    prm.add_parameter("Density",
                      density,
                      "Mass density [kg/m^3]; 0 takes the catalogue's.",
                      Patterns::Double(0.));
    prm.add_parameter("Young's modulus",
                      youngs_modulus,
                      "Young's modulus E [Pa]; 0 takes the catalogue's.",
                      Patterns::Double(0.));
    prm.add_parameter(
        "Poisson's ratio",
        poissons_ratio,
        "Poisson's ratio [1], from 0 to below 0.5; -1 takes the catalogue's.",
        Patterns::Double(-1., 1.));
    prm.add_parameter(
        "Toughness",
        toughness,
        "Area U under the stress-strain curve up to failure [J/m^3]; 0 takes "
        "the catalogue's.",
        Patterns::Double(0.));
    prm.add_parameter(
        "Compressive strength",
        compressive_strength,
        "Uniaxial compressive strength f_c [Pa]; 0 takes the catalogue's or, "
        "where that has none, sqrt(2 E U).",
        Patterns::Double(0.));
    prm.add_parameter(
        "Law",
        law,
        "Elastic law: 'neo-Hookean' (finite strain, stable in strong "
        "compression) or 'linear' (small strain, for problems with a linear "
        "closed form).",
        Patterns::Selection("neo-Hookean|linear"));
    prm.add_parameter("Plane stress",
                      plane_stress,
                      "A thin plate instead of plane strain; static solutions "
                      "alone take it.");
  }


  DamageParameters
  DamageParameters::left_open()
  {
    DamageParameters parameters;
    parameters.flaws              = "catalogue";
    parameters.correlation_length = 0.;
    parameters.weibull_modulus    = 0.;
    parameters.strength_ratio     = 0.;
    parameters.fracture_energy    = -1.;
    parameters.threshold_factor   = 0.;
    return parameters;
  }


  void
  DamageParameters::declare(dealii::ParameterHandler &prm)
  {
    const DamageParameters defaults;
    prm.add_parameter("Enabled", enabled, "Whether the solid can fail.");
    prm.add_parameter(
        "Driver",
        driver,
        "What drives damage: 'tensile stress' (T3-55; sees nothing in uniaxial "
        "compression), 'extension strain' (one strength for both), or "
        "'modified von Mises' (separate compressive and tensile strength).",
        Patterns::Selection(
            "tensile stress|extension strain|modified von Mises"));
    prm.add_parameter(
        "Growth",
        growth,
        "How damage grows beyond the threshold: 'energy softening' (the "
        "strength falls with the energy dissipated, independent of rate), "
        "'linear softening' (with the largest undamaged stress so far; brittle "
        "in compression whatever the range) or 'Grady-Kipp' (T3-53, T3-54; "
        "strength grows with rate).",
        Patterns::Selection("energy softening|linear softening|Grady-Kipp"));
    prm.add_parameter(
        "Softening",
        softening,
        "What damage takes away: 'deviator' (the deviator and tensile "
        "pressure) or 'tensile principal' (T3-56: tensile principal stresses "
        "alone).",
        Patterns::Selection("deviator|tensile principal"));
    prm.add_parameter(
        "Flaws",
        flaws,
        "Thresholds of the particles, all a function of the seed: 'Weibull' "
        "(independent of each other), 'correlated' (a field of the place, the "
        "same at every resolution), 'Benz-Asphaug' (explicit flaws, handed out "
        "until each particle has one; with Grady-Kipp growth each activated "
        "flaw adds to the rate) or 'uniform'. 'catalogue': the catalogue's, "
        "else '" +
            defaults.flaws + "'.",
        Patterns::Selection(
            "catalogue|Weibull|correlated|Benz-Asphaug|uniform"));
    prm.add_parameter("Correlation length",
                      correlation_length,
                      "Length l of the correlated field of thresholds [m]: its "
                      "correlation at a distance r is exp(-r^2/(2 l^2))." +
                          else_default("0", defaults.correlation_length),
                      Patterns::Double(0.));
    prm.add_parameter("Weibull modulus",
                      weibull_modulus,
                      "Weibull modulus m of the flaw thresholds, at least 1 "
                      "[1]." +
                          else_default("0", defaults.weibull_modulus),
                      Patterns::Double(0., 200.));
    prm.add_parameter("Strength ratio",
                      strength_ratio,
                      "Compressive over tensile strength f_c/f_t, at least 1 "
                      "[1]." +
                          else_default("0", defaults.strength_ratio),
                      Patterns::Double(0., 100.));
    prm.add_parameter(
        "Softening range",
        softening_range,
        "Linear softening ends at this multiple of the threshold [1]; with a "
        "fracture energy that decides instead.",
        Patterns::Double(1.01, 1000.));
    prm.add_parameter(
        "Fracture energy",
        fracture_energy,
        "Energy G_c that a unit area of crack takes in tension [J/m^2], "
        "K_Ic^2 (1 - nu^2)/E: the softening ends where it must for that "
        "(crack band), whatever the spacing; 0: the softening range holds." +
            else_default("-1", defaults.fracture_energy),
        Patterns::Double(-1.));
    prm.add_parameter(
        "Threshold factor",
        threshold_factor,
        "Factor c of the threshold rule r_i = c w_i / b(m, range) [1]: above 1 "
        "makes good for the weakest-link loss of a block between plates; "
        "--calibrate finds it." +
            else_default("0", defaults.threshold_factor),
        Patterns::Double(0., 100.));
    prm.add_parameter(
        "Face exclusion",
        face_exclusion,
        "The tensile cut-off sigma_1/f_t does not act within this many "
        "spacings of loaded faces, where numerical tension stands [1].",
        Patterns::Double(0., 100.));
    prm.add_parameter(
        "Average stress",
        average_stress,
        "Drive damage by the stress averaged over undamaged neighbours.");
    prm.add_parameter(
        "Granular friction",
        granular_friction,
        "Friction coefficient of failed material (Drucker-Prager, "
        "sqrt(J2) <= friction * pressure) [1].",
        Patterns::Double(0., 10.));
  }
} // namespace Morsel::Materials
