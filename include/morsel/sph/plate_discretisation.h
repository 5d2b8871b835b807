#ifndef morsel_sph_plate_discretisation_h
#define morsel_sph_plate_discretisation_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Morsel::SPH
{
  /// How particles discretise a cracked plate.
  struct PlateDiscretisation
  {
    unsigned int particles_x = 100, particles_y = 100;
    bool         fit_to_cracks = true;
    double       scatter       = 0.; ///< [spacings]
    unsigned int seed          = 1;

    std::string kernel          = "cubic B-spline";
    double      smoothing_ratio = 1.3;
    std::string gradient        = "conforming";
    double      hourglass       = 0.3;
    std::string tip_handling    = "visibility";

    /// Binds all members to entries of the section "SPH".
    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::SPH

#endif
