#ifndef morsel_sph_force_kernels_h
#define morsel_sph_force_kernels_h

// The second loop over bonded pairs, forces and artificial viscosity. Compiled
// once per instruction set.

#include <morsel/sph/bonded_kernels.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// Subtracts V_j/V_i P_j G_ji of the pairs at @p k.
    MORSEL_INLINE void
    take_back(const BondedArrays &a, const unsigned int k, V &f_x, V &f_y)
    {
      Matrix Q;
      gather_records(
          neighbours_in(a.pair_stress, a.index + k), Q.xx, Q.xy, Q.yx, Q.yy);
      const V b_x = load(a.back_x + k), b_y = load(a.back_y + k);
      f_x -= Q.xx * b_x + Q.xy * b_y;
      f_y -= Q.yx * b_x + Q.yy * b_y;
    }


    /// What viscosity adds to the acceleration of a particle, by T3-44 (sign
    /// corrected) along the present direction r to its neighbour, with the
    /// reference gradient's weight: -q r, where
    /// q = a mu (beta mu - alpha c), mu = h min(0, v.r)/(r^2 + 0.01 h^2).
    MORSEL_INLINE void
    add_viscosity(const BondedConstants &c,
                  const V                weight,
                  const V                r_x,
                  const V                r_y,
                  const V                v_x,
                  const V                v_y,
                  V                     &g_x,
                  V                     &g_y)
    {
      const double h  = c.smoothing_length;
      const V      vr = smaller(v_x * r_x + v_y * r_y, V{}); // approaching
      const V      mu = h * vr / (r_x * r_x + r_y * r_y + 0.01 * h * h);
      const V q = weight * mu * (c.viscosity_beta * mu - c.viscosity_alpha_c);
      g_x -= q * r_x;
      g_y -= q * r_y;
    }


    /// Writes what a row of particles is accelerated by.
    /// @param f force per volume [N/m^3]; @param g by viscosity [m/s^2]
    template <bool viscosity>
    MORSEL_INLINE void
    store_acceleration(const BondedArrays      &a,
                       const BondedConstants   &c,
                       const Row               &row,
                       const V                  f_x,
                       const V                  f_y,
                       [[maybe_unused]] const V g_x,
                       [[maybe_unused]] const V g_y)
    {
      const double inverse_density = 1. / c.density;
      V            a_x = inverse_density * f_x, a_y = inverse_density * f_y;
      if constexpr (viscosity)
        {
          a_x += g_x;
          a_y += g_y;
          scatter_pairs(row.to(a.viscous), row.n, g_x, g_y);
        }
      scatter_pairs(row.to(a.acceleration), row.n, a_x, a_y);
    }


    /// dv_i/dt = 1/rho_0 sum_j a_ij [(T_i + T_j) X_ij + k_ij u_ij], with
    /// T = P B - k_hg H / 2 and k_ij = (k_hg,i + k_hg,j) / 2: stress and
    /// the residual of the linear fit in one sweep. Every term changes but
    /// its sign when i and j are exchanged. With the conforming gradient
    /// dv_i/dt = 1/rho_0 sum_j [P_i G_ij - V_j/V_i P_j G_ji +
    ///   a_ij ((S_i + S_j) X_ij + k_ij u_ij)],  S = P R^T C - k_hg H_fit / 2.
    template <bool viscosity, bool varying, Gradient kind>
    MORSEL_INLINE void
    force_row(const BondedArrays    &a,
              const BondedConstants &c,
              const unsigned int     g,
              const unsigned int     offset)
    {
      const Row row(a, g * group_size + offset);
      V         u_x, u_y, v_x, v_y, T_xx, T_xy, T_yx, T_yy;
      if constexpr (viscosity)
        gather_records(row.of(a.motion), u_x, u_y, v_x, v_y);
      else
        gather_pairs(row.of(a.motion), u_x, u_y);
      constexpr bool          conforming = kind == Gradient::conforming;
      const Offsets<kind>     offsets(a, row);
      const PairStress *const weighted =
          conforming ? a.fit_stress : a.pair_stress;
      gather_records(row.of(weighted), T_xx, T_xy, T_yx, T_yy);
      V hg = all(c.uniform_hourglass);
      if constexpr (varying)
        hg = 0.5 * gather([&](unsigned int l) {
               return &a.hourglass[row.particle(l)];
             });

      V                  f_x{}, f_y{};
      [[maybe_unused]] V g_x{}, g_y{};
      const unsigned int near_end = conforming ? a.near_end[g] : a.slot_end[g];
      for (unsigned int s = a.slot_begin[g]; s < near_end; ++s)
        {
          const unsigned int  k     = s * group_size + offset;
          const unsigned int *index = a.index + k;
          const V             w     = load(a.weight + k);
          V                   X, Y;
          offsets.get(k, X, Y);
          V du_x, du_y, dv_x, dv_y, S_xx, S_xy, S_yx, S_yy;
          if constexpr (viscosity)
            gather_records(
                neighbours_in(a.motion, index), du_x, du_y, dv_x, dv_y);
          else
            gather_pairs(neighbours_in(a.motion, index), du_x, du_y);
          gather_records(
              neighbours_in(weighted, index), S_xx, S_xy, S_yx, S_yy);
          du_x -= u_x;
          du_y -= u_y;
          V kij = hg;
          if constexpr (varying)
            kij += 0.5 * gather(neighbours_in(a.hourglass, index));
          f_x += w * ((T_xx + S_xx) * X + (T_xy + S_xy) * Y + kij * du_x);
          f_y += w * ((T_yx + S_yx) * X + (T_yy + S_yy) * Y + kij * du_y);
          if constexpr (conforming)
            take_back(a, k, f_x, f_y);

          if constexpr (viscosity)
            {
              const V r_x = X + du_x, r_y = Y + du_y;
              add_viscosity(c,
                            conforming ? load(a.damping + k) : w,
                            r_x,
                            r_y,
                            dv_x - v_x,
                            dv_y - v_y,
                            g_x,
                            g_y);
            }
        }

      if constexpr (conforming)
        {
          for (unsigned int s = near_end; s < a.slot_end[g]; ++s)
            take_back(a, s * group_size + offset, f_x, f_y);
          Matrix P;
          V      G_x, G_y;
          gather_records(row.of(a.pair_stress), P.xx, P.xy, P.yx, P.yy);
          gather_pairs(row.of(a.own_sum), G_x, G_y);
          f_x += P.xx * G_x + P.xy * G_y;
          f_y += P.yx * G_x + P.yy * G_y;
        }
      store_acceleration<viscosity>(a, c, row, f_x, f_y, g_x, g_y);
    }


    /// The same as force_row() on a lattice. What whole pairs X and -X take of
    /// a particle's own stress cancels.
    template <bool viscosity, bool varying, Pairs pairs>
    MORSEL_INLINE void
    lattice_force_row(const BondedArrays    &a,
                      const BondedConstants &c,
                      const unsigned int     g,
                      const unsigned int     offset)
    {
      const LatticeArrays &lattice = a.lattice;
      const Row            row(a, g * group_size + offset);
      const auto column = [&](const LatticeColumn k, const unsigned int i) {
        return load(lattice.column[k] + i);
      };
      const V            own_x = column(column_u_x, row.first);
      const V            own_y = column(column_u_y, row.first);
      [[maybe_unused]] V own_v_x, own_v_y, hg, T_xx, T_xy, T_yx, T_yy;
      if constexpr (viscosity)
        {
          own_v_x = column(column_v_x, row.first);
          own_v_y = column(column_v_y, row.first);
        }
      if constexpr (varying)
        hg = 0.5 * load(a.hourglass + row.first);
      if constexpr (pairs == Pairs::frayed)
        {
          T_xx = column(column_xx, row.first);
          T_xy = column(column_xy, row.first);
          T_yx = column(column_yx, row.first);
          T_yy = column(column_yy, row.first);
        }

      V                  f_x{}, f_y{}, e_x{}, e_y{};
      [[maybe_unused]] V g_x{}, g_y{};
      // Residual and viscosity of one pair.
      const auto add =
          [&](const unsigned int j, const V w, const V X, const V Y) {
            const V d_x = column(column_u_x, j) - own_x;
            const V d_y = column(column_u_y, j) - own_y;
            V       k   = w;
            if constexpr (varying)
              k *= hg + 0.5 * load(a.hourglass + j);
            e_x += k * d_x;
            e_y += k * d_y;
            if constexpr (viscosity)
              add_viscosity(c,
                            w,
                            X + d_x,
                            Y + d_y,
                            column(column_v_x, j) - own_v_x,
                            column(column_v_y, j) - own_v_y,
                            g_x,
                            g_y);
          };
      const unsigned int *first = lattice.first + 2 * g * lattice.n_twos;
      for (unsigned int t = 0; t < lattice.n_twos; ++t, first += 2)
        {
          const unsigned int i = first[0] + offset, j = first[1] + offset;
          const V            X = all(lattice.x[t]), Y = all(lattice.y[t]);
          if constexpr (pairs == Pairs::regular)
            {
              const V w_x  = all(lattice.weight_x[t]);
              const V w_y  = all(lattice.weight_y[t]);
              const V S_xx = column(column_xx, i) - column(column_xx, j);
              const V S_xy = column(column_xy, i) - column(column_xy, j);
              const V S_yx = column(column_yx, i) - column(column_yx, j);
              const V S_yy = column(column_yy, i) - column(column_yy, j);
              f_x += w_x * S_xx + w_y * S_xy;
              f_y += w_x * S_yx + w_y * S_yy;
              const V w = all(lattice.weight[t]);
              add(i, w, X, Y);
              add(j, w, -X, -Y);
            }
          else
            {
              const TwoWeights w(a, g, offset, t);
              const auto       S = [&](const LatticeColumn k, const V T) {
                return w.ahead * (column(k, i) + T) -
                       w.back * (column(k, j) + T);
              };
              f_x += X * S(column_xx, T_xx) + Y * S(column_xy, T_xy);
              f_y += X * S(column_yx, T_yx) + Y * S(column_yy, T_yy);
              add(i, w.ahead, X, Y);
              add(j, w.back, -X, -Y);
            }
        }
      const double scale = varying ? 1. : c.uniform_hourglass;
      f_x += scale * e_x;
      f_y += scale * e_y;
      store_acceleration<viscosity>(a, c, row, f_x, f_y, g_x, g_y);
    }


    template <bool viscosity, bool varying, Gradient kind = Gradient::fit>
    void
    force_loop(const BondedArrays    &a,
               const BondedConstants &c,
               const unsigned int     begin,
               const unsigned int     end)
    {
      for (unsigned int g = begin; g < end; ++g)
        if (is_retired(a, g))
          {
            for (unsigned int i = g * group_size;
                 i < (g + 1) * group_size && i < a.n_owned;
                 ++i)
              {
                a.acceleration[i] = {0., 0.};
                if constexpr (viscosity)
                  a.viscous[i] = {0., 0.};
              }
          }
        else
          {
            const Pairs pairs =
                kind == Gradient::fit ? pairs_of(a, g) : Pairs::list;
            for (unsigned int offset = 0; offset < group_size; offset += lanes)
              if (pairs == Pairs::regular)
                lattice_force_row<viscosity, varying, Pairs::regular>(
                    a, c, g, offset);
              else if (pairs == Pairs::frayed)
                lattice_force_row<viscosity, varying, Pairs::frayed>(
                    a, c, g, offset);
              else
                force_row<viscosity, varying, kind>(a, c, g, offset);
          }
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
