#ifndef morsel_sph_bonds_h
#define morsel_sph_bonds_h

#include <morsel/core/kernel.h>
#include <morsel/fracture/crack.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/particles.h>

#include <deal.II/base/aligned_vector.h>

#include <vector>

namespace Morsel::SPH
{
  /// The bonds once more, in the order in which the kernels read them: slot s
  /// of a group holds one pair of each of its particles, and what is stored
  /// per pair stands at [s * group_size, (s + 1) * group_size). Rows that are
  /// shorter than the group's longest end in pairs of weight zero of the
  /// particle with itself.
  struct PackedBonds
  {
    std::vector<unsigned int> slot_begin; ///< of each group
    std::vector<unsigned int> slot_end;   ///< the same once all have failed

    dealii::AlignedVector<double>       weight; ///< a_ij [1/m^2]
    dealii::AlignedVector<double>       dx, dy; ///< X_j - X_i [m]
    dealii::AlignedVector<unsigned int> index;

    // Only where bonds can break.
    dealii::AlignedVector<double> average; ///< W(|X_ij|) while uncut [1/m^2]
    std::vector<unsigned int>     place;   ///< where each entry of Bonds went
  };


  /// The reference pairs of a total Lagrangian solid. Entry k of row i
  /// carries weight a_ij = V_j |W'|/R (zero once cut), X_j - X_i and, where
  /// bonds can break, the place of the pair's other entry.
  ///
  /// The gradient matrix B_i = (sum_j a_ij X_ij (x) X_ij)^-1 makes
  /// H_i = sum_j a_ij u_ij (x) B_i X_ij the least-squares fit of a linear
  /// field with the weights a_ij, so that the residual-of-fit hourglass term
  /// with k_ij ~ a_ij needs no second fit.
  struct Bonds
  {
    NeighbourList             list;
    std::vector<double>       weight; ///< a_ij [1/m^2]
    std::vector<double>       dx, dy; ///< X_j - X_i [m]
    std::vector<unsigned int> mirror; ///< entry (j, i) of entry (i, j)
    PackedBonds               packed;

    /// @param cracks past which particles do not see each other
    void
    build(const Particles                    &particles,
          const Kernel                       &kernel,
          const std::vector<Fracture::Crack> &cracks = {});

    /// Fills what cuts and averages need; to be called before the first.
    void
    make_breakable(const Kernel &kernel);

    /// Cuts the pair of entry @p k for good.
    void
    cut(unsigned int k);

    /// Leaves group @p g out of the loops from now on: all of it has failed.
    void
    retire(const unsigned int g)
    {
      packed.slot_end[g] = packed.slot_begin[g];
    }

    /// Entry of the pair (i, j), or -1 where it is not in the list.
    long
    find(unsigned int i, unsigned int j) const;

    double
    length_square(const unsigned int k) const
    {
      return dx[k] * dx[k] + dy[k] * dy[k];
    }

    /// Moment matrix sum_j a_ij X_ij (x) X_ij of the uncut bonds [1].
    Symmetric2
    moment(unsigned int i) const;

    /// |sum_j a_ij X_ij| [1/m]: zero inside a lattice, about 0.4/dp in the
    /// outermost row.
    double
    surface_measure(unsigned int i) const;

  private:
    void
    pack();
  };


  /// Smaller eigenvalue of a symmetric matrix.
  double
  smaller_eigenvalue(const Symmetric2 &m);

  /// Inverse of a symmetric matrix; precondition: not singular.
  Symmetric2
  inverse(const Symmetric2 &m);
} // namespace Morsel::SPH

#endif
