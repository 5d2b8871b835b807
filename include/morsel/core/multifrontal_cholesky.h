#ifndef morsel_core_multifrontal_cholesky_h
#define morsel_core_multifrontal_cholesky_h

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace Morsel
{
  /// The nodes of each element: those of element e are index[start[e]] to
  /// index[start[e + 1]], each of them once.
  struct ElementNodes
  {
    std::vector<unsigned int> start{0};
    std::vector<unsigned int> index;

    unsigned int
    n_elements() const
    {
      return start.size() - 1;
    }
  };


  /// In what order the nodes of a sum of element matrices are eliminated, and
  /// in what dense blocks: nested dissection by coordinates (George 1973) and
  /// the multifrontal method (Duff and Reid 1983). A front holds the nodes of
  /// a separator, or of a leaf, and those that its elimination couples.
  struct Dissection
  {
    struct Front
    {
      unsigned int              begin, end; ///< positions of its own nodes
      std::vector<unsigned int> boundary;   ///< positions of the later ones
      std::vector<unsigned int> children;
      std::vector<unsigned int> elements;

      unsigned int
      n_own() const
      {
        return end - begin;
      }

      unsigned int
      n_nodes() const
      {
        return n_own() + boundary.size();
      }
    };

    Dissection(const std::vector<dealii::Point<2>> &points,
               const ElementNodes                  &nodes);

    std::vector<Front>        fronts;   ///< children before their parent
    std::vector<unsigned int> position; ///< of each node in the order
    /// Fronts that do not depend on each other, the leaves first.
    std::vector<std::vector<unsigned int>> levels;

    /// Of the factor, with two unknowns for each node.
    double
    n_entries() const;
  };


  /// The Cholesky factorisation of a sum of element matrices with two unknowns
  /// for each node, numbered 2 node + component. Elements are added to the
  /// front where the first of their nodes is eliminated; the sum is never
  /// stored. Fronts that do not depend on each other are worked on by several
  /// threads; the outcome does not depend on their number.
  class MultifrontalCholesky
  {
  public:
    /// Writes an element's matrix by columns; its lower triangle counts. The
    /// unknowns of its node k are 2 k and 2 k + 1.
    using ElementMatrix =
        std::function<void(unsigned int element, std::vector<double> &matrix)>;

    /// @param order and @param nodes are kept by reference
    MultifrontalCholesky(const Dissection    &order,
                         const ElementNodes  &nodes,
                         const ElementMatrix &matrix);

    /// Whether the matrix is positive definite, up to rounding.
    bool
    succeeded() const
    {
      return success;
    }

    /// y = A^-1 x.
    void
    solve(double *y, const double *x) const;

  private:
    /// What a front leaves to its parent: the lower triangle of the Schur
    /// complement and the sums of the elements' diagonals.
    struct Remainder
    {
      std::vector<double> matrix, size;
    };

    bool
    eliminate(const unsigned int front, const ElementMatrix &element_matrix);
    void
    add_elements(const unsigned int   front,
                 const ElementMatrix &element_matrix,
                 Remainder           &sum) const;
    void
    add_children(const unsigned int front, Remainder &sum);
    unsigned int
    place(const Dissection::Front &front, const unsigned int position) const;

    const Dissection                &order;
    const ElementNodes              &nodes;
    std::vector<std::vector<double>> factors; ///< of the fronts' own columns
    std::vector<Remainder>           remainders;
    bool                             success = true;
  };
} // namespace Morsel

#endif
