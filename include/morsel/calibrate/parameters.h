#ifndef morsel_calibrate_parameters_h
#define morsel_calibrate_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Morsel::Calibrate
{
  /// What --calibrate shall reach, and how: section "Calibration" of a scene,
  /// which a plain run does not look at.
  struct CalibrationParameters
  {
    double       compressive_strength = 0.; ///< target [Pa], 0 = the material's
    std::string  compression_result   = "compressive_strength";
    double       tensile_strength     = 0.; ///< target [Pa], 0 = none
    std::string  tension_scene;             ///< relative to the scene's file
    std::string  tension_result   = "tensile_strength";
    unsigned int particles_across = 0;    ///< 0 = the scene's own
    unsigned int seeds            = 3;    ///< the mean over so many counts
    double       tolerance        = 0.01; ///< of the mean, relative [1]
    unsigned int rounds           = 6;    ///< at most
    unsigned int side_by_side     = 0;    ///< 0 = as many as there are cores
    double       time_limit       = 0.;   ///< of a run [s], 0 = none

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Calibrate

#endif
