#ifndef morsel_fe_element_system_h
#define morsel_fe_element_system_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <deal.II/lac/affine_constraints.h>

#include <Eigen/Dense>

#include <vector>

namespace Morsel::FE
{
  /// One element's share of a symmetric system.
  struct ElementSystem
  {
    std::vector<unsigned int> dofs; ///< each at most once
    Eigen::MatrixXd           matrix;
    Eigen::VectorXd           rhs;
    dealii::Point<2>          center;           ///< orders the elements [m]
    bool                      enriched = false; ///< tells where cracks are
  };


  /// Replaces constrained dofs by their masters: C^T K C, C^T (f - K g) with
  /// u = C v + g.
  void
  condense(ElementSystem                           &element,
           const dealii::AffineConstraints<double> &constraints);


  /// The sum of the elements' right hand sides.
  Eigen::VectorXd
  assemble_rhs(const std::vector<ElementSystem> &elements,
               const unsigned int                n_dofs);


  /// All ranks' elements on rank 0, none elsewhere. Collective.
  std::vector<ElementSystem>
  gather_elements(std::vector<ElementSystem> &&mine,
                  const MPI_Comm               communicator);
} // namespace Morsel::FE

#endif
