#ifndef morsel_fe_multifrontal_h
#define morsel_fe_multifrontal_h

#include <morsel/fe/element_system.h>

#include <vector>

namespace Morsel::FE
{
  /// Direct solver for symmetric positive definite systems given element by
  /// element: multifrontal Cholesky factorisation (Duff and Reid 1983) over a
  /// nested dissection of the elements. It takes the element matrices as they
  /// are; no global sparse matrix is built, and what is internal to an
  /// element is condensed before it meets its neighbours. A pivot that round-
  /// off leaves without significance is dropped: its unknown becomes zero.
  class Multifrontal
  {
  public:
    /// Factorises the matrix sum_e K_e; the elements' right hand sides are not
    /// used.
    /// @param elements consumed
    /// @param n_dofs   length of vectors
    void
    factorise(std::vector<ElementSystem> &&elements, const unsigned int n_dofs);

    /// Solves with the factorised matrix; dofs of no element get 0.
    /// @param rhs by dof
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    /// Unknowns whose pivot was dropped.
    unsigned int
    n_dropped_pivots() const
    {
      return n_dropped;
    }

    /// Smallest kept pivot over its dof's diagonal entry: how close to
    /// dependence the functions come.
    double
    smallest_relative_pivot() const
    {
      return smallest_pivot;
    }

    /// Largest order of a dense front.
    unsigned int
    largest_front() const
    {
      return max_front;
    }

  private:
    struct Front
    {
      std::vector<unsigned int> dofs;
      Eigen::MatrixXd           matrix;
    };
    struct Factor
    {
      std::vector<unsigned int> dofs;
      unsigned int              n_eliminated = 0;
      Eigen::MatrixXd           columns; ///< L11 over L21
      std::vector<bool>         dropped;
    };

    Front
    factor(const unsigned int begin, const unsigned int end);
    Front
    merge(Front &a, Front &b);
    Front
    eliminate(Front &&front, const unsigned int begin, const unsigned int end);
    void
    order(const unsigned int begin, const unsigned int end);
    std::vector<ElementSystem> elements;
    std::vector<unsigned int>  position;    ///< elements in tree order
    std::vector<unsigned int>  first, last; ///< by dof, in that order
    std::vector<double>        diagonal;
    std::vector<unsigned int>  place;   ///< scratch of merge(), by dof
    std::vector<Factor>        factors; ///< in order of elimination
    unsigned int               n_dropped      = 0;
    double                     smallest_pivot = 1.;
    unsigned int               max_front      = 0;
  };
} // namespace Morsel::FE

#endif
