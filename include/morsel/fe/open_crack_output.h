#ifndef morsel_fe_open_crack_output_h
#define morsel_fe_open_crack_output_h

#include <morsel/fe/elastic_problem.h>
#include <morsel/fe/stress_intensity.h>

#include <string>
#include <vector>

namespace Morsel::FE
{
  /// The solution as the text of a ParaView file (vtu): every cell is divided
  /// along the cracks and drawn with points of its own, so that the deformed
  /// crack is really open. Points carry displacement [m], stress and von
  /// Mises stress [Pa] and the distance to the nearest tip in units of the
  /// outermost ring [1]; cells carry the number of the mesh's cell on this
  /// rank, the kind of enrichment (0 none, 1 jump, 2 tip, 3 both) and the
  /// degree. This rank's cells only.
  /// @param divisions of every uncut cell per direction; within the rings it
  ///   is finer
  std::string
  open_crack_vtu(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 const std::vector<TipResult>   &tips,
                 const unsigned int              divisions);


  /// The vertices that carry an enrichment as points (vtu): its kind (1 jump,
  /// 2 tip functions, 3 both) and the ramp there, which is 1 in the core and
  /// 0 where the tip functions have faded out. This rank's cells only.
  std::string
  enriched_nodes_vtu(const XFEMSpace &space);
} // namespace Morsel::FE

#endif
