#ifndef morsel_materials_parameters_h
#define morsel_materials_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Morsel::Materials
{
  /// What one solid is made of. Every value that is zero ("0 = from the
  /// catalogue") is filled from the named catalogue entry before use.
  struct MaterialParameters
  {
    /// Entry of the shipped catalogue, or "inline": all values stand here.
    std::string name           = "inline";
    double      density        = 0.;  ///< [kg/m^3]
    double      youngs_modulus = 0.;  ///< [Pa]
    double      poissons_ratio = -1.; ///< [1], -1 = from the catalogue
    double      toughness = 0.; ///< area under the stress-strain curve [J/m^3]
    double      compressive_strength = 0.;    ///< f_c [Pa], 0 = sqrt(2 E U)
    std::string law          = "neo-Hookean"; ///< "neo-Hookean" or "linear"
    bool        plane_stress = false;         ///< in static solutions only

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// How the solid fails. The three choices (driver, growth, softening)
  /// compose.
  struct DamageParameters
  {
    bool        enabled   = false;
    std::string driver    = "modified von Mises";
    std::string growth    = "energy softening";
    std::string softening = "deviator";
    std::string flaws     = "Weibull";

    double weibull_modulus = 8.; ///< m [1]
    /// Compressive over tensile strength f_c/f_t [1].
    double strength_ratio = 10.;
    /// The softening ends at this multiple of the threshold [1].
    double softening_range = 10.;
    double fracture_energy = 0.; ///< G_c [J/m^2], 0: the range holds
    /// Of the field of thresholds with 'correlated' flaws [m].
    double correlation_length = 5e-4;
    double threshold_factor   = 1.; ///< c of the threshold rule r_i = c w_i/b
    /// Tensile cut-off is off within this many spacings of loaded faces [1].
    double face_exclusion = 2.5;
    /// Driver from the stress averaged over undamaged neighbours.
    bool average_stress = true;
    /// Friction coefficient of failed material [1] (Drucker-Prager).
    double granular_friction = 0.5;

    /// The same, with what the catalogue may know left open: 0 (fracture
    /// energy -1), flaws 'catalogue'. So scenes begin, and complete() fills.
    static DamageParameters
    left_open();

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Materials

#endif
