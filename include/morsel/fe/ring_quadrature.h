#ifndef morsel_fe_ring_quadrature_h
#define morsel_fe_ring_quadrature_h

#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/xfem_space.h>
#include <morsel/fracture/interaction_integral.h>

#include <functional>
#include <vector>

namespace Morsel::FE
{
  using UseOfRingCell =
      std::function<void(const dealii::DoFHandler<2>::active_cell_iterator &,
                         const QuadMap &,
                         const CellQuadrature &)>;

  /// The cells of this rank that rings about a tip reach, each with a
  /// quadrature that suits a gradient times the rings' weights.
  void
  for_each_ring_cell(const XFEMSpace                   &space,
                     const Fracture::CrackTip          &tip,
                     const std::vector<Fracture::Ring> &rings,
                     const UseOfRingCell               &use);
} // namespace Morsel::FE

#endif
