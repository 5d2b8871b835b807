#ifndef morsel_fracture_parameters_h
#define morsel_fracture_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// The cracks that a body has from the beginning, and what is expected of
  /// their tips.
  struct BodyCracks
  {
    std::string         paths;            ///< "x, y > x, y; ..."
    double              ring_radius = 0.; ///< [m], 0: the largest that fits
    std::vector<double> expected_I, expected_II; ///< by tip [Pa sqrt(m)]

    /// Binds all members to entries of the section "Cracks".
    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Fracture

#endif
