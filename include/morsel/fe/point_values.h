#ifndef morsel_fe_point_values_h
#define morsel_fe_point_values_h

#include <morsel/fe/elastic_problem.h>
#include <morsel/fracture/tip_fields.h>

#include <vector>

namespace Morsel::FE
{
  /// Displacement and gradient at any points of the body; collective over
  /// all ranks, each of which gets all values. On a face between cells the
  /// mean of both sides is taken; on a crack, the side is the user's choice
  /// by a point a little off it.
  /// @pre all points lie in the body
  std::vector<Fracture::DisplacementSample>
  sample_points(const ElasticProblem                &problem,
                const ElasticProblem::Solution      &solution,
                const std::vector<dealii::Point<2>> &points);
} // namespace Morsel::FE

#endif
