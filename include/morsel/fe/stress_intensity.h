#ifndef morsel_fe_stress_intensity_h
#define morsel_fe_stress_intensity_h

#include <morsel/fe/elastic_problem.h>
#include <morsel/fracture/tip_result.h>

namespace Morsel::FE
{
  using Fracture::TipResult;


  /// Distance from a point to the boundary of the mesh [m].
  double
  distance_to_boundary(const dealii::Triangulation<2> &triangulation,
                       const dealii::Point<2>         &p);


  /// About one tip the layer of cells in which its functions fade out.
  struct BlendingLayer
  {
    double inner_radius; ///< nearest point of such a cell [m]
    double outer_radius; ///< farthest one [m]
  };

  /// Collective over all ranks; without any such cell both radii are 0.
  BlendingLayer
  find_blending_layer(const XFEMSpace &space, const unsigned int tip);


  /// Three rings about a tip that stay clear of the boundary, kinks and other
  /// cracks, and inside the blending layer of the tip functions where at
  /// least two cells lie between it and the tip. Where rings overlap that
  /// layer they are counted; at degree 1, where this costs accuracy, and
  /// where rings are thinner than 4/degree cells, there is a remark.
  /// @param radius wished outer radius of the largest ring [m], 0: the
  ///   largest that fits
  /// @throws InputError if the wished ring does not fit between the tip and
  ///   its surroundings
  TipResult
  choose_rings(const XFEMSpace   &space,
               const unsigned int tip,
               const double       radius);


  /// Interaction integral over the given rings on the finite element field.
  /// @param both_components whether J_2 is wanted, too; it needs the strain
  ///   energy along the crack's faces
  void
  evaluate_rings(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 TipResult                      &result,
                 const bool                      both_components = false);
} // namespace Morsel::FE

#endif
