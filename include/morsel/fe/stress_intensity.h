#ifndef morsel_fe_stress_intensity_h
#define morsel_fe_stress_intensity_h

#include <morsel/fe/elastic_problem.h>
#include <morsel/fracture/interaction_integral.h>

#include <string>
#include <vector>

namespace Morsel::FE
{
  /// Stress intensity at one tip, ring by ring.
  struct TipResult
  {
    unsigned int                           tip = 0;
    std::vector<Fracture::Ring>            rings;
    std::vector<Fracture::StressIntensity> by_ring;
    std::vector<double>                    energy_release; ///< J [J/m^2]
    Fracture::RingStatistics               statistics;
    /// What was wrong with the rings wished for; empty if nothing.
    std::string remark;
  };


  /// Distance from a point to the boundary of the mesh [m].
  double
  distance_to_boundary(const dealii::Triangulation<2> &triangulation,
                       const dealii::Point<2>         &p);


  /// Rings about a tip that stay clear of boundary, kinks, other cracks and,
  /// where there is room, of the blending layer of the tip functions. Rings
  /// thinner than 4/degree cells bring a remark.
  /// @param radius wished outer radius of the largest ring [m], 0: the
  ///   largest that fits
  /// @throws InputError if no ring fits between the tip and its surroundings
  TipResult
  choose_rings(const XFEMSpace   &space,
               const unsigned int tip,
               const double       radius);


  /// Interaction integral over the given rings on the finite element field.
  void
  evaluate_rings(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 TipResult                      &result);
} // namespace Morsel::FE

#endif
