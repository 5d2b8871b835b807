#ifndef morsel_fe_sparse_assembly_h
#define morsel_fe_sparse_assembly_h

#include <morsel/fe/element_system.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>

namespace Morsel::FE
{
  /// Sums element matrices into a distributed sparse matrix; rows of no element
  /// get 1 on the diagonal. Collective.
  /// @param rows_of an element's rows by its dofs; invalid_dof_index: left out
  /// @param owned   this rank's rows, one contiguous range
  void
  assemble_matrix(
      const std::vector<ElementSystem>       &elements,
      const std::function<std::vector<dealii::types::global_dof_index>(
          const ElementSystem &)>            &rows_of,
      const dealii::IndexSet                 &owned,
      const MPI_Comm                          communicator,
      dealii::TrilinosWrappers::SparseMatrix &matrix);
} // namespace Morsel::FE

#endif
