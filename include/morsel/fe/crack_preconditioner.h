#ifndef morsel_fe_crack_preconditioner_h
#define morsel_fe_crack_preconditioner_h

#include <morsel/fe/multifrontal.h>
#include <morsel/fe/phantom_nodes.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace Morsel::FE
{
  /// Direct solution on the dofs about the cracks and tips, factorised once on
  /// rank 0.
  class PatchSolver
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Collective.
    /// @param elements this rank's
    /// @param marks    positive on the patch's dofs, with ghost values
    PatchSolver(const std::vector<ElementSystem> &elements,
                const PhantomNodes::DofField     &marks);

    /// Adds R^T (R A R^T)^-1 R r, R being the restriction to the patch.
    void
    add_correction(Vector &z, const Vector &r) const;

    unsigned int
    n_dofs() const
    {
      return size;
    }

  private:
    MPI_Comm                  communicator;
    std::vector<unsigned int> mine; ///< places in this rank's share of a vector
    std::vector<int>          counts, offsets; ///< by rank, on rank 0
    unsigned int              size = 0;
    Multifrontal              factorisation; ///< on rank 0
  };


  /// Algebraic multigrid (Trilinos ML, smoothed aggregation with the rigid
  /// motions as near null space) on the nodes of base and split jump functions.
  class NodalMultigrid
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Collective.
    NodalMultigrid(const std::vector<ElementSystem>        &elements,
                   const XFEMSpace                         &space,
                   const dealii::AffineConstraints<double> &constraints,
                   const PhantomNodes                      &nodes);

    /// Adds one V-cycle for the residual r.
    void
    add_correction(Vector &z, const Vector &r) const;

  private:
    struct Slots;

    Slots
    number(const XFEMSpace                         &space,
           const dealii::AffineConstraints<double> &constraints,
           const PhantomNodes                      &nodes);
    void
    assemble(const std::vector<ElementSystem> &elements, const Slots &slots);
    void
    build(std::vector<double> &modes);

    /// By owned row of the multigrid matrix: the place in this rank's share of
    /// a vector, or none for a constrained component of a node.
    std::vector<unsigned int>                 place_of_row;
    dealii::TrilinosWrappers::SparseMatrix    matrix;
    dealii::TrilinosWrappers::PreconditionAMG cycle;
    mutable Vector                            input, output;
  };


  /// Preconditioner of the enriched system in the basis of PhantomNodes:
  /// symmetric multiplicative Schwarz of a direct solution about the cracks,
  /// one multigrid cycle on the nodes, and the direct solution again.
  class CrackPreconditioner
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    CrackPreconditioner(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                        const PatchSolver                            &patch,
                        const NodalMultigrid &multigrid);

    void
    vmult(Vector &z, const Vector &r) const;

  private:
    const dealii::TrilinosWrappers::SparseMatrix &matrix;
    const PatchSolver                            &patch;
    const NodalMultigrid                         &multigrid;
    mutable Vector                                rest;
  };
} // namespace Morsel::FE

#endif
