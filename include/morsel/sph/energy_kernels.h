#ifndef morsel_sph_energy_kernels_h
#define morsel_sph_energy_kernels_h

// Stored energies of bonded particles, for the groups of bonded_kernels.h.
// Compiled once per instruction set.

#include <morsel/sph/bonded_kernels.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// J^2 - 1 - 2 ln J.
    MORSEL_INLINE V
    volumetric_measure(const V J)
    {
      const V e = J - 1.;
      if (!any(e * e > 4e-4 || e != e))
        // e^2 + 2 (e - ln(1 + e)) without the difference of like numbers.
        return e * e +
               2. * (e * e) *
                   (0.5 +
                    e * (-1. / 3. +
                         e * (0.25 +
                              e * (-0.2 +
                                   e * (1. / 6. +
                                        e * (-1. / 7. +
                                             e * (0.125 - e * (1. / 9.))))))));
      V result;
      for (unsigned int l = 0; l < lanes; ++l)
        result[l] = J[l] * J[l] - 1. - 2. * __builtin_log(J[l]);
      return result;
    }


    /// Energies per volume of a displacement gradient [J/m^3].
    struct StoredEnergies
    {
      V deviatoric, volumetric;
      V compressed; ///< below zero where the volume is

      /// What damage takes away.
      MORSEL_INLINE V
      releasable() const
      {
        return deviatoric + (compressed < 0. ? V{} : volumetric);
      }

      /// With a share @p keep left of what damage takes away.
      MORSEL_INLINE V
      left(const V keep) const
      {
        return keep * deviatoric +
               (compressed < 0. ? volumetric : keep * volumetric);
      }
    };


    template <bool linear_law>
    MORSEL_INLINE StoredEnergies
    stored_energies(const BondedConstants &c, const Matrix &H)
    {
      if constexpr (linear_law)
        {
          const V tr = H.xx + H.yy, third = tr * (1. / 3.);
          const V d_xx = H.xx - third, d_yy = H.yy - third;
          const V e_xy = 0.5 * (H.xy + H.yx);
          return {c.mu * (d_xx * d_xx + d_yy * d_yy + third * third +
                          2. * (e_xy * e_xy)),
                  0.5 * c.bulk * (tr * tr),
                  tr};
        }
      else
        {
          const V F_xx = 1. + H.xx, F_yy = 1. + H.yy;
          const V J = F_xx * F_yy - H.xy * H.yx;
          const V b = F_xx * F_xx + H.xy * H.xy + H.yx * H.yx + F_yy * F_yy;
          return {
              larger(V{},
                     1.5 * c.mu *
                         (power_minus_two_thirds(J) * ((b + 1.) * (1. / 3.)) -
                          1.)),
              0.25 * c.bulk * volumetric_measure(J),
              J - 1.};
        }
    }


    /// sum_j a_ij |u_ij - H X_ij|^2 [m^2].
    MORSEL_INLINE V
    residual(const BondedArrays &a,
             const Row          &row,
             const unsigned int  g,
             const unsigned int  offset,
             const Matrix       &H)
    {
      const auto square =
          [&](const V u_x, const V u_y, const V X, const V Y) -> V {
        const V e_x = u_x - H.xx * X - H.xy * Y;
        const V e_y = u_y - H.yx * X - H.yy * Y;
        return e_x * e_x + e_y * e_y;
      };
      V u_x, u_y, sum{};
      gather_pairs(row.of(a.motion), u_x, u_y);
      if (pairs_of(a, g) == Pairs::regular)
        {
          const LatticeArrays &lattice = a.lattice;
          const double *const  all_x   = lattice.column[column_u_x] + offset;
          const double *const  all_y   = lattice.column[column_u_y] + offset;
          const unsigned int  *first   = lattice.first + 2 * g * lattice.n_twos;
          for (unsigned int t = 0; t < lattice.n_twos; ++t, first += 2)
            {
              const V X = all(lattice.x[t]), Y = all(lattice.y[t]);
              sum += lattice.weight[t] * (square(load(all_x + first[0]) - u_x,
                                                 load(all_y + first[0]) - u_y,
                                                 X,
                                                 Y) +
                                          square(u_x - load(all_x + first[1]),
                                                 u_y - load(all_y + first[1]),
                                                 X,
                                                 Y));
            }
          return sum;
        }
      for (unsigned int s = a.slot_begin[g]; s < a.slot_end[g]; ++s)
        {
          const unsigned int k = s * group_size + offset;
          V                  v_x, v_y;
          gather_pairs(neighbours_in(a.motion, a.index + k), v_x, v_y);
          sum += load(a.weight + k) *
                 square(v_x - u_x, v_y - u_y, load(a.dx + k), load(a.dy + k));
        }
      return sum;
    }


    /// Adds up what the particles of each group store at their present
    /// gradients [J], see BondedArrays::energy. Columns are those of the
    /// present displacements.
    template <bool linear_law, bool softened>
    void
    energy_loop(const BondedArrays    &a,
                const BondedConstants &c,
                const unsigned int     begin,
                const unsigned int     end)
    {
      for (unsigned int g = begin; g < end; ++g)
        {
          GroupEnergy energy{0., 0.};
          for (unsigned int offset = 0; offset < group_size; offset += lanes)
            {
              const Row row(a, g * group_size + offset);
              Matrix    H;
              gather_records(row.of(a.gradient), H.xx, H.xy, H.yx, H.yy);
              V share = all(1. / c.density); // volume, or 0 where there is none
              share *= gather(
                  [&](unsigned int l) { return &a.mass[row.particle(l)]; });
              V keep = all(1.);
              if constexpr (softened)
                keep -= gather(
                    [&](unsigned int l) { return &a.damage[row.particle(l)]; });
              for (unsigned int l = 0; l < lanes; ++l)
                if (l >= row.n || (softened && a.failed[row.particle(l)]))
                  share[l] = 0.;
              V strain = share * stored_energies<linear_law>(c, H).left(keep);
              if (a.modulus)
                strain *= gather([&](unsigned int l) {
                  return &a.modulus[row.particle(l)];
                });
              const V stiffness = gather([&](unsigned int l) {
                return &a.hourglass[row.particle(l)];
              });
              energy.strain += sum(strain);
              energy.hourglass += sum(0.25 * share * stiffness *
                                      residual(a, row, g, offset, H));
            }
          a.energy[g] = energy;
        }
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
