#ifndef morsel_fe_enrichment_rule_h
#define morsel_fe_enrichment_rule_h

#include <morsel/fe/xfem_space.h>

#include <string>
#include <vector>

namespace Morsel::FE
{
  /// Edge length of the smallest cell that holds a point [m].
  double
  cell_size_at(const dealii::Triangulation<2> &mesh, const dealii::Point<2> &p);


  /// Tip functions within six cells of each tip, with the ramp, times
  /// functions of the body's degree; fewer where the crack's segment at the tip
  /// is short: they jump along its straight continuation.
  /// @param cracks with their mouths extended beyond the body
  std::vector<EnrichmentParameters>
  enrichment_by_rule(const dealii::Triangulation<2>     &mesh,
                     const std::vector<Fracture::Crack> &cracks,
                     unsigned int                        degree);


  /// Refuses two tips in one cell. Neither crack's jump function then lives
  /// there, and the tip functions cannot stand in for both: K was 5 to 7
  /// percent wrong in silence. Overlapping zones of tip functions cost
  /// nothing measurable. Collective.
  /// @param remedy what the user may do
  /// @throws InputError
  void
  check_tips_apart(const dealii::Triangulation<2>        &mesh,
                   const std::vector<Fracture::CrackTip> &tips,
                   const std::string                     &remedy);


  /// Refuses tips that hardly differ from what they are near to, as the mesh
  /// sees it: no ring could tell their stress intensity, and its quadrature
  /// would take for ever. Collective; the degrees need not be known yet.
  /// @param ring_radius wished outer radius of the largest ring [m], 0: the
  ///   largest that fits
  /// @param remedy what the user may do besides
  /// @throws InputError
  void
  check_room_for_rings(const XFEMSpace   &space,
                       double             ring_radius,
                       const std::string &remedy);
} // namespace Morsel::FE

#endif
