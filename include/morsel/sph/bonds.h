#ifndef morsel_sph_bonds_h
#define morsel_sph_bonds_h

#include <morsel/core/kernel.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/sph/lattice_groups.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/particles.h>
#include <morsel/sph/visibility.h>

#include <deal.II/base/aligned_vector.h>

#include <vector>

namespace Morsel::SPH
{
  struct ConformingWeights;


  /// The bonds once more, in the order in which the kernels read them: slot s
  /// of a group holds one pair of each of its particles, and what is stored
  /// per pair stands at [s * group_size, (s + 1) * group_size). Rows that are
  /// shorter than the group's longest end in pairs of weight zero of the
  /// particle with itself.
  struct PackedBonds
  {
    std::vector<unsigned int> slot_begin; ///< of each group
    std::vector<unsigned int> slot_end;   ///< the same once all have failed
    /// Of the slots of pairs with a weight, which come first; the others have
    /// but a conforming gradient.
    std::vector<unsigned int> near_end;

    dealii::AlignedVector<double> weight; ///< a_ij [1/m^2]
    /// X_j - X_i [m]; not with the conforming gradient.
    dealii::AlignedVector<double>       dx, dy;
    dealii::AlignedVector<unsigned int> index;

    // Only with the conforming gradient.
    dealii::AlignedVector<double> own_x, own_y;   ///< G_ij [1/m]
    dealii::AlignedVector<double> back_x, back_y; ///< V_j/V_i G_ji [1/m]
    dealii::AlignedVector<double> damping;        ///< of viscosity [1/m^2]

    // Only where bonds can break.
    dealii::AlignedVector<double> average; ///< W(|X_ij|) while uncut [1/m^2]
    /// Where each entry of Bonds went: those of the owned particles.
    std::vector<unsigned int> place;
  };


  /// What is found out about bonds, and which of them are listed.
  struct BondOptions
  {
    /// Search for regular groups, see LatticeGroups.
    bool search_lattice = false;
    /// Some may be cut: regular groups may need their lists, and rows of
    /// ghosts say which bonds of theirs live. Else only the owned particles
    /// have rows.
    bool breaks = true;
    /// Particles before it are sent to other ranks.
    unsigned int first_without_ghosts = 0;
  };


  /// The reference pairs of a total Lagrangian solid. Entry k of row i
  /// carries weight a_ij = V_j |W'|/R (zero once cut) and, where bonds can
  /// break, whether it lives and the place of the pair's other entry.
  ///
  /// With the conforming gradient, it carries G_ij and V_j/V_i G_ji besides,
  /// and the weight is that of the residual control, a_ij = V_j W/R^2. Pairs
  /// are those of G, of its transpose and of the residual control together.
  ///
  /// The gradient matrix B_i = (sum_j a_ij X_ij (x) X_ij)^-1 makes
  /// H_i = sum_j a_ij u_ij (x) B_i X_ij the least-squares fit of a linear
  /// field with the weights a_ij, so that the residual-of-fit hourglass term
  /// with k_ij ~ a_ij needs no second fit.
  struct Bonds
  {
    NeighbourList             list;
    std::vector<double>       weight; ///< a_ij [1/m^2]
    std::vector<char>         live;   ///< not cut; empty where none can be
    std::vector<unsigned int> mirror; ///< entry (j, i) of entry (i, j)
    PackedBonds               packed;
    LatticeGroups             lattice; ///< empty unless searched for

    // Only with the conforming gradient.
    std::vector<Vector2> own;  ///< G_ij [1/m]
    std::vector<Vector2> back; ///< V_j/V_i G_ji [1/m]

    /// The eigenvalues of moment() inside of a body [1].
    double full_moment = 1.;

    /// Pairs that do not see each other have no bond.
    void
    build(const Particles   &particles,
          const Kernel      &kernel,
          const Visibility  &visibility = Visibility(),
          const BondOptions &options    = {});

    /// The same with the conforming gradient, for all particles that this
    /// rank knows, which go by their ids. Those of other ranks lack what no
    /// owned particle takes part in.
    void
    build_conforming(const Particles         &particles,
                     const ConformingWeights &whole,
                     const Kernel            &kernel);

    bool
    is_conforming() const
    {
      return !own.empty();
    }

    /// Fills what cuts and averages need; to be called before the first.
    void
    make_breakable(const Particles &particles, const Kernel &kernel);

    /// Cuts the pair of entry @p k for good.
    void
    cut(unsigned int k);

    /// Leaves group @p g out of the loops from now on: all of it has failed.
    void
    retire(const unsigned int g)
    {
      packed.slot_end[g] = packed.near_end[g] = packed.slot_begin[g];
    }

    /// Saves which bonds are cut; cuts them on loading. To be called after
    /// @p particles has named them.
    void
    exchange_state(StateArchive &state, const Particles &particles);

    /// Entries in the rows of the owned particles; 0 where none can be cut.
    unsigned int
    n_packed() const
    {
      return packed.place.size();
    }

    /// The particle whose row holds @p entry.
    unsigned int
    row_of(unsigned int entry) const;

    /// Entry of the pair (i, j), or -1 where it is not in the list.
    long
    find(unsigned int i, unsigned int j) const;

    /// X_j - X_i of entry @p k in row @p i [m].
    Vector2
    offset(const Particles   &particles,
           const unsigned int i,
           const unsigned int k) const
    {
      const auto &X = particles.reference[i];
      const auto &Y = particles.reference[list.index[k]];
      return {Y[0] - X[0], Y[1] - X[1]};
    }

    /// Its square [m^2].
    double
    length_square(const Particles   &particles,
                  const unsigned int i,
                  const unsigned int k) const
    {
      const Vector2 X = offset(particles, i, k);
      return X.x * X.x + X.y * X.y;
    }

    /// Moment matrix sum_j a_ij X_ij (x) X_ij of the uncut bonds [1].
    Symmetric2
    moment(const Particles &particles, unsigned int i) const;

    /// sum_j X_ij (x) G_ij of the uncut bonds [1]: the unit matrix while none
    /// is cut. Only with the conforming gradient.
    Tensor2
    gradient_moment(const Particles &particles, unsigned int i) const;

    /// sum_j G_ij of the uncut bonds [1/m]. Only with the conforming gradient.
    Vector2
    gradient_sum(unsigned int i) const;

    /// Half of what @p particles' surface vector is with the kernel's own
    /// gradient, |sum_j V_j grad W_ij| [1/m]: zero inside a lattice, about
    /// 0.4/dp in the outermost row.
    double
    surface_measure(unsigned int     i,
                    const Particles &particles,
                    const Kernel    &kernel) const;

    /// Whether a particle of the intact body lies on its surface.
    bool
    on_surface(const unsigned int i,
               const Particles   &particles,
               const Kernel      &kernel) const
    {
      return surface_measure(i, particles, kernel) * particles.spacing >
             surface_limit;
    }

  private:
    /// Of surface_measure() times the spacing [1]: the outermost row has about
    /// 0.4, the second one less than 0.1.
    static constexpr double surface_limit = 0.2;

    static constexpr unsigned int nowhere = -1;

    /// Entries of row @p i that have a weight.
    unsigned int
    n_near(unsigned int i) const;

    /// Lays out the rows of the owned particles and what every form has.
    /// @param all also of regular groups
    void
    pack(const Particles &particles, unsigned int n_owned, bool all = true);

    /// The same and what the conforming gradient has besides.
    void
    pack_conforming(const Particles &particles, const Kernel &kernel);

    /// Lays out a further quantity of the pairs.
    /// @param value of the entry k of row i, value(i, k)
    template <typename Value>
    void
    pack(const Value &value, dealii::AlignedVector<double> &packed_values) const
    {
      packed_values.resize(packed.index.size(), 0.);
      for (unsigned int i = 0; list.start[i] < packed.place.size(); ++i)
        for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
          if (packed.place[k] != nowhere)
            packed_values[packed.place[k]] = value(i, k);
    }
  };


  /// Smaller eigenvalue of a symmetric matrix.
  double
  smaller_eigenvalue(const Symmetric2 &m);

  /// Inverse of a symmetric matrix; precondition: not singular.
  Symmetric2
  inverse(const Symmetric2 &m);
} // namespace Morsel::SPH

#endif
