#ifndef morsel_fe_discretisation_h
#define morsel_fe_discretisation_h

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>

namespace Morsel::FE
{
  /// How extended finite elements discretise a cracked plate.
  struct Discretisation
  {
    unsigned int          cells_x = 13, cells_y = 13;
    std::array<double, 2> line_shift{{0., 0.}}; ///< [cells]

    unsigned int degree             = 4;
    double       degree_drop        = 0.; ///< [1/level]
    unsigned int smallest_degree    = 2;
    unsigned int tip_degree         = 3;
    double       enrichment_radius  = 8e-4; ///< [m]
    bool         ramp               = true;
    unsigned int corner_refinements = 6;
    unsigned int tip_refinements    = 0;
    double       layers             = 0.5;
    unsigned int adaptive_steps     = 0;
    double       refined_share      = 0.1;
    std::string  solver             = "multifrontal";

    /// Binds all members to entries of the section "XFEM".
    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::FE

#endif
