#ifndef morsel_fe_phantom_nodes_h
#define morsel_fe_phantom_nodes_h

#include <morsel/fe/element_system.h>
#include <morsel/fe/xfem_space.h>

namespace Morsel::FE
{
  /// The two sides of a jump as unknowns of their own. A base function N with
  /// the unknown u and its jump function H N with the unknown a span the same
  /// as N (1+H)/2 and N (1-H)/2 with u+ = u + a and u- = u - a, each of which
  /// lives on one side of the crack only (Hansbo and Hansbo 2004). In this
  /// basis the two sides are not coupled through the crack, as on a mesh that
  /// is really torn, and algebraic multigrid works (Gerstenberger and
  /// Tuminaro 2013). Where two jumps share a base function, one is split.
  class PhantomNodes
  {
  public:
    using DofField = dealii::LinearAlgebra::distributed::Vector<double>;

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// Collective.
    /// @param constraints closed, with the boundary conditions
    PhantomNodes(const XFEMSpace                         &space,
                 const dealii::AffineConstraints<double> &constraints);

    /// Changes a condensed element from (u, a) to (u+, u-).
    void
    split(ElementSystem &element) const;

    /// Changes a vector with ghost values from (u+, u-) to (u, a), the owned
    /// entries.
    void
    join(DofField &u) const;

    /// Whether the dof is the minus side of a node that is split.
    bool
    is_minus_side(const dealii::types::global_dof_index dof) const
    {
      return at(base_of, dof) != none;
    }

    /// Zeros on this rank's dofs, with ghost values for all others that its
    /// condensed elements name.
    DofField
    zero_field() const
    {
      return DofField(jump_of.get_partitioner());
    }

  private:
    static unsigned int
    at(const DofField &field, const dealii::types::global_dof_index dof)
    {
      return field(dof) > 0. ? static_cast<unsigned int>(field(dof) - 0.5)
                             : none;
    }

    DofField jump_of, base_of; ///< number of the partner plus 1; 0: none
  };
} // namespace Morsel::FE

#endif
