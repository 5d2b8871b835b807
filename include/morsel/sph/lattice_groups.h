#ifndef morsel_sph_lattice_groups_h
#define morsel_sph_lattice_groups_h

#include <morsel/sph/neighbours.h>
#include <morsel/sph/pair_kernels.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <vector>

namespace Morsel::SPH
{
  struct Bonds;
  struct Particles;

  /// The groups of particles deep inside of a regular lattice: all of them have
  /// the same pairs, no pair is cut, and what stands beside one another in a
  /// group has neighbours that do so, too, be they this rank's or ghosts. Their
  /// loops need no list of pairs: one pattern serves all, and the fields of
  /// neighbours are read from columns (one number after the other) as whole
  /// vectors.
  class LatticeGroups
  {
  public:
    /// Finds the groups in @p bonds, none of which is cut yet; nothing is
    /// allocated where there are none. Pairs of the pattern get its offsets and
    /// weights in all rows, so that the two ends of a pair agree to the bit
    /// whatever their groups go by.
    /// @param first_without_ghosts particles before it are sent to other ranks
    void
    find(const Particles &particles,
         Bonds           &bonds,
         unsigned int     first_without_ghosts);

    bool
    empty() const
    {
      return use.empty();
    }

    /// X_ij as the pattern has it where @p entry of row @p i is one of its
    /// pairs, else as given: the two ends of a pair agree to the bit.
    Vector2
    adjusted(const Vector2 &offset,
             const Bonds   &bonds,
             unsigned int   i,
             unsigned int   entry) const;

    bool
    is_regular(const unsigned int g) const
    {
      return !use.empty() && (use[g] & regular);
    }

    /// How many groups are worked on by the pattern.
    unsigned int
    size() const
    {
      return n_regular;
    }

    /// A pair of particle @p i is to be cut: from now on its group goes by the
    /// weights of its own pairs.
    void
    leave(unsigned int i, const NeighbourList &list);

    /// @name Of other ranks' particles, into the columns; between the owned
    /// ones' (whose last group writes over the first of the ghosts) and the
    /// loops that read them.
    ///@{
    void
    take_motion_of_ghosts(const Particles &particles) const;

    void
    take_stress_of_ghosts(const Particles &particles) const;
    ///@}

    /// Fills the addresses of @p arrays.
    void
    describe(LatticeArrays &arrays);

  private:
    /// Bits of a group's use.
    enum Use : char
    {
      regular       = lattice_regular,
      needs_records = lattice_needs_records,
      needs_columns = lattice_needs_columns,
      frayed        = lattice_frayed
    };

    /// Whether the pairs of group @p g are those of the pattern.
    bool
    fits(const Particles &particles, const Bonds &bonds, unsigned int g) const;

    /// Takes the pairs of particle @p i for the pattern if each has an opposite
    /// one.
    void
    make_pattern(const Particles &particles,
                 const Bonds     &bonds,
                 unsigned int     i);

    /// Puts the @p entries of row @p i into the order of the pattern's pairs,
    /// which is theirs but at the cut to another rank. @return whether they are
    /// these
    bool
    in_order(const Particles           &particles,
             const Bonds               &bonds,
             unsigned int               i,
             std::vector<unsigned int> &entries) const;

    /// Whether a pair with this weight is the pattern's pair @p k, as rows are
    /// sorted.
    bool
    is_pair(const Vector2 &offset, double weight_of_pair, unsigned int k) const;

    /// Which pair of the pattern @p entry of row @p i is, or past the last.
    unsigned int
    pair_of(const Vector2 &offset,
            const Bonds   &bonds,
            unsigned int   i,
            unsigned int   entry) const;

    /// Gives the entries of row @p i the pattern's weights where they are its
    /// pairs.
    void
    adjust_weights(const Particles &particles,
                   Bonds           &bonds,
                   unsigned int     i) const;

    /// Tells the groups of @p g's neighbours in what form it reads them.
    void
    mark_neighbours(const NeighbourList &list, unsigned int g, Use form);

    unsigned int              n_owned = 0, n_regular = 0;
    std::vector<char>         use;   ///< of each group
    std::vector<unsigned int> first; ///< neighbours of each group's first

    // Half of the pairs: X and -X take the same weight.
    std::vector<double> x, y; ///< [m]
    std::vector<double> weight, weight_x, weight_y;
    double              heaviest = 0.; ///< weight [1/m^2]
    double              spacing  = 0.; ///< [m]
    Symmetric2          shape;         ///< B [1]

    /// Copies of the particles' fields for the loops.
    mutable std::array<dealii::AlignedVector<double>, n_lattice_columns>
        columns;
  };
} // namespace Morsel::SPH

#endif
