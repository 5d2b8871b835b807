#ifndef morsel_fracture_parameters_h
#define morsel_fracture_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// The cracks that a body has from the beginning.
  struct CrackPaths
  {
    std::string paths;            ///< "x, y > x, y; ..."
    double      ring_radius = 0.; ///< [m], 0: the largest that fits

    /// Binds all members to entries of the section "Cracks".
    /// @param meaning a sentence about what cracks do to the kind of body
    void
    declare(dealii::ParameterHandler &prm, const std::string &meaning);
  };


  /// Those of particles, and what is expected of their tips.
  struct BodyCracks : CrackPaths
  {
    std::vector<double> expected_I, expected_II; ///< by tip [Pa sqrt(m)]

    /// Binds all members to entries of the section "Cracks".
    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Fracture

#endif
