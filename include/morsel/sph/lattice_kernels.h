#ifndef morsel_sph_lattice_kernels_h
#define morsel_sph_lattice_kernels_h

// What the kernels of bonded particles do without lists, see LatticeGroups.
// Compiled once per instruction set.

#include <morsel/sph/group_rows.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// Where the pairs of a group come from.
    enum class Pairs
    {
      list,
      regular, ///< the lattice's pattern
      frayed   ///< the same, but some are cut: weights are the group's
    };


    MORSEL_INLINE Pairs
    pairs_of(const BondedArrays &a, const unsigned int g)
    {
      const char use = a.lattice.use ? a.lattice.use[g] : char(0);
      return use & lattice_regular  ? Pairs::regular
             : use & lattice_frayed ? Pairs::frayed
                                    : Pairs::list;
    }


    /// All of group @p g has failed.
    MORSEL_INLINE bool
    is_retired(const BondedArrays &a, const unsigned int g)
    {
      return a.slot_begin[g] == a.slot_end[g] &&
             pairs_of(a, g) != Pairs::regular;
    }


    /// The weights of the pairs at X and -X of a frayed group.
    struct TwoWeights
    {
      V ahead, back;

      MORSEL_INLINE
      TwoWeights(const BondedArrays &a,
                 const unsigned int  g,
                 const unsigned int  offset,
                 const unsigned int  t)
      {
        // Rows are sorted by their neighbours: from the last at -X to X.
        const unsigned int first = a.slot_begin[g], n = a.lattice.n_twos;
        back  = load(a.weight + (first + t) * group_size + offset);
        ahead = load(a.weight + (first + 2 * n - 1 - t) * group_size + offset);
      }
    };


    /// sum_j a_ij u_ij (x) X_ij on a lattice: of whole pairs X and -X the
    /// particle's own displacement drops out.
    template <Pairs pairs>
    MORSEL_INLINE Matrix
    lattice_moment(const BondedArrays &a,
                   const unsigned int  g,
                   const unsigned int  offset)
    {
      const LatticeArrays &lattice = a.lattice;
      const double *const  u_x     = lattice.column[column_u_x] + offset;
      const double *const  u_y     = lattice.column[column_u_y] + offset;
      const unsigned int   i       = g * group_size;
      const unsigned int  *first   = lattice.first + 2 * g * lattice.n_twos;
      Matrix               moment;
      for (unsigned int t = 0; t < lattice.n_twos; ++t, first += 2)
        if constexpr (pairs == Pairs::regular)
          moment.add(load(u_x + first[0]) - load(u_x + first[1]),
                     load(u_y + first[0]) - load(u_y + first[1]),
                     all(lattice.weight_x[t]),
                     all(lattice.weight_y[t]));
        else
          {
            const TwoWeights w(a, g, offset, t);
            moment.add(w.ahead * (load(u_x + first[0]) - load(u_x + i)) -
                           w.back * (load(u_x + first[1]) - load(u_x + i)),
                       w.ahead * (load(u_y + first[0]) - load(u_y + i)) -
                           w.back * (load(u_y + first[1]) - load(u_y + i)),
                       all(lattice.x[t]),
                       all(lattice.y[t]));
          }
      return moment;
    }


    /// Displacements, and velocities for viscosity, into the lattice's columns.
    template <bool velocities>
    void
    fill_columns(const BondedArrays &a,
                 const BondedConstants &,
                 const unsigned int begin,
                 const unsigned int end)
    {
      for (unsigned int g = begin; g < end; ++g)
        if (a.lattice.use[g] & lattice_needs_columns)
          for (unsigned int offset = 0; offset < group_size; offset += lanes)
            {
              const Row row(a, g * group_size + offset);
              V         u_x, u_y, v_x, v_y;
              if constexpr (velocities)
                {
                  gather_records(row.of(a.motion), u_x, u_y, v_x, v_y);
                  store(a.lattice.column[column_v_x] + row.first, v_x);
                  store(a.lattice.column[column_v_y] + row.first, v_y);
                }
              else
                gather_pairs(row.of(a.motion), u_x, u_y);
              store(a.lattice.column[column_u_x] + row.first, u_x);
              store(a.lattice.column[column_u_y] + row.first, u_y);
            }
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
