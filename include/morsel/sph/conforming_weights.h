#ifndef morsel_sph_conforming_weights_h
#define morsel_sph_conforming_weights_h

#include <morsel/sph/discrete_gradient.h>

namespace Morsel::SPH
{
  /// The weights of a whole body that takes the conforming gradient, its
  /// particles in the order of their ids. Cells at the boundary and shape
  /// functions that were widened decide together how far pairs reach, so that
  /// ranks cannot know it before all of them are there: each works out all.
  struct ConformingWeights
  {
    DiscreteGradient gradient;
    ResidualControl  control;    ///< for a modulus of 1 Pa
    double           reach = 0.; ///< length of the longest pair [m]

    ConformingWeights(const Cloud      &cloud,
                      const Kernel     &kernel,
                      const Visibility &visibility = Visibility());
  };
} // namespace Morsel::SPH

#endif
