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
      const PairStress *const weighted =
          conforming ? a.fit_stress : a.pair_stress;
      gather_records(row.of(weighted), T_xx, T_xy, T_yx, T_yy);
      V hg = all(c.uniform_hourglass);
      if constexpr (varying)
        hg = 0.5 * gather([&](unsigned int l) {
               return &a.hourglass[row.particle(l)];
             });

      const double       h     = c.smoothing_length;
      [[maybe_unused]] V alpha = all(c.viscosity_alpha_c);
      V                  f_x{}, f_y{};
      [[maybe_unused]] V g_x{}, g_y{};
      const unsigned int near_end = conforming ? a.near_end[g] : a.slot_end[g];
      for (unsigned int s = a.slot_begin[g]; s < near_end; ++s)
        {
          const unsigned int  k     = s * group_size + offset;
          const unsigned int *index = a.index + k;
          const V             w     = load(a.weight + k);
          const V             X = load(a.dx + k), Y = load(a.dy + k);
          V                   du_x, du_y, dv_x, dv_y, S_xx, S_xy, S_yx, S_yy;
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
              // Pi_ij of T3-44 (sign corrected) along the current pair
              // direction, with the reference gradient's weight.
              const V r_x = X + du_x, r_y = Y + du_y;
              const V vr = smaller((dv_x - v_x) * r_x + (dv_y - v_y) * r_y,
                                   V{}); // approaching
              const V mu = h * vr / (r_x * r_x + r_y * r_y + 0.01 * h * h);
              const V q  = (conforming ? load(a.damping + k) : w) * mu *
                          (c.viscosity_beta * mu - alpha);
              g_x -= q * r_x;
              g_y -= q * r_y;
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


    template <bool viscosity, bool varying, Gradient kind = Gradient::fit>
    void
    force_loop(const BondedArrays    &a,
               const BondedConstants &c,
               const unsigned int     begin,
               const unsigned int     end)
    {
      for (unsigned int g = begin; g < end; ++g)
        if (a.slot_begin[g] == a.slot_end[g])
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
          for (unsigned int offset = 0; offset < group_size; offset += lanes)
            force_row<viscosity, varying, kind>(a, c, g, offset);
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
