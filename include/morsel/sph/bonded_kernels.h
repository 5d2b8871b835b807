#ifndef morsel_sph_bonded_kernels_h
#define morsel_sph_bonded_kernels_h

// The two loops over bonded pairs, for groups of eight particles whose pairs
// stand side by side. Compiled once per instruction set.

#include <morsel/sph/pair_kernels.h>
#include <morsel/sph/vector_lanes.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// What softening does: see Materials::soften().
    enum Softened
    {
      intact,
      softened_deviator,
      softened_principal
    };

    struct Stress
    {
      V xx, yy, xy, zz;
    };


    /// Particles [first, first + lanes) of a group; lanes past the last
    /// owned particle repeat it and are never stored.
    struct Row
    {
      unsigned int first, last, n;

      Row(const BondedArrays &a, const unsigned int first)
          : first(first)
          , last(a.n_owned - 1)
          , n(a.n_owned > first ? a.n_owned - first : 0)
      {}

      MORSEL_INLINE unsigned int
      particle(const unsigned int l) const
      {
        return first + l < last ? first + l : last;
      }

      template <typename Record>
      MORSEL_INLINE auto
      of(Record *records) const
      {
        return [this, records](const unsigned int l) {
          return (const double *)(records + particle(l));
        };
      }

      template <typename Record>
      MORSEL_INLINE auto
      to(Record *records) const
      {
        return [this, records](const unsigned int l) {
          return (double *)(records + first + l);
        };
      }
    };


    MORSEL_INLINE Stress
    soften_principal(const Stress &s, const V keep)
    {
      const V centre = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
      const V radius = square_root(half * half + s.xy * s.xy);
      const V s1 = centre + radius, s2 = centre - radius;
      const V t1      = s1 > 0. ? keep * s1 : s1;
      const V t2      = s2 > 0. ? keep * s2 : s2;
      const V inverse = 1. / (radius > 0. ? radius : all(1.));
      const V c2      = radius > 0. ? half * inverse : all(1.);
      const V mean = 0.5 * (t1 + t2), amplitude = 0.5 * (t1 - t2);
      return {mean + amplitude * c2,
              mean - amplitude * c2,
              amplitude * (s.xy * inverse),
              s.zz > 0. ? keep * s.zz : s.zz};
    }


    /// @tparam own_fit the gradient is not the least-squares fit, so that the
    ///   hourglass term needs the fit's matrix beside the gradient's.
    template <bool linear_law, Softened softened, bool own_fit>
    MORSEL_INLINE void
    strain_row(const BondedArrays    &a,
               const BondedConstants &c,
               const unsigned int     g,
               const unsigned int     offset)
    {
      const Row row(a, g * group_size + offset);
      V         u_x, u_y;
      gather_pairs(row.of(a.motion), u_x, u_y);
      V m_xx{}, m_xy{}, m_yx{}, m_yy{};
      for (unsigned int s = a.slot_begin[g]; s < a.slot_end[g]; ++s)
        {
          const unsigned int k = s * group_size + offset;
          V                  du_x, du_y;
          gather_pairs(neighbours_in(a.motion, a.index + k), du_x, du_y);
          du_x -= u_x;
          du_y -= u_y;
          const V w  = load(a.weight + k);
          const V ax = w * load(a.dx + k), ay = w * load(a.dy + k);
          m_xx += du_x * ax;
          m_xy += du_x * ay;
          m_yx += du_y * ax;
          m_yy += du_y * ay;
        }
      const V B_xx =
          gather([&](unsigned int l) { return &a.shape[row.particle(l)].xx; });
      const V B_yy =
          gather([&](unsigned int l) { return &a.shape[row.particle(l)].yy; });
      const V B_xy =
          gather([&](unsigned int l) { return &a.shape[row.particle(l)].xy; });
      const V H_xx = m_xx * B_xx + m_xy * B_xy;
      const V H_xy = m_xx * B_xy + m_xy * B_yy;
      const V H_yx = m_yx * B_xx + m_yy * B_xy;
      const V H_yy = m_yx * B_xy + m_yy * B_yy;
      const V F_xx = 1. + H_xx, F_yy = 1. + H_yy;

      Stress deviator;
      V      mean;
      if constexpr (linear_law)
        {
          const V tr = H_xx + H_yy, third = tr / 3.;
          deviator = {2. * c.mu * (H_xx - third),
                      2. * c.mu * (H_yy - third),
                      c.mu * (H_xy + H_yx),
                      -2. * c.mu * third};
          mean     = c.bulk * tr;
        }
      else
        {
          const V J         = F_xx * F_yy - H_xy * H_yx;
          const V inverse_J = 1. / J;
          const V b_xx      = F_xx * F_xx + H_xy * H_xy;
          const V b_yy      = H_yx * H_yx + F_yy * F_yy;
          const V b_xy      = F_xx * H_yx + H_xy * F_yy;
          const V third     = (b_xx + b_yy + 1.) * (1. / 3.);
          const V factor    = c.mu * power_minus_two_thirds(J) * inverse_J;
          deviator          = {factor * (b_xx - third),
                               factor * (b_yy - third),
                               factor * b_xy,
                               factor * (1. - third)};
          mean              = 0.5 * c.bulk * (J - inverse_J);
          if constexpr (softened != intact)
            if (any(!(J > c.crushed_jacobian)))
              a.crushed[g] = 1;
        }

      Stress sigma = {deviator.xx + mean,
                      deviator.yy + mean,
                      deviator.xy,
                      deviator.zz + mean};
      if constexpr (softened != intact)
        {
          scatter_records(row.to(a.effective),
                          row.n,
                          sigma.xx,
                          sigma.yy,
                          sigma.xy,
                          sigma.zz);
          const V keep = 1. - gather([&](unsigned int l) {
                           return &a.damage[row.particle(l)];
                         });
          if constexpr (softened == softened_principal)
            {
              if (any(keep < 1.))
                sigma = soften_principal(sigma, keep);
            }
          else
            {
              mean  = mean < 0. ? mean : keep * mean;
              sigma = {keep * deviator.xx + mean,
                       keep * deviator.yy + mean,
                       keep * deviator.xy,
                       keep * deviator.zz + mean};
            }
        }

      V P_xx = sigma.xx, P_xy = sigma.xy, P_yx = sigma.xy, P_yy = sigma.yy;
      if constexpr (!linear_law)
        {
          // P = J sigma F^-T; J F^-T is the cofactor matrix of F.
          P_xx = sigma.xx * F_yy - sigma.xy * H_xy;
          P_xy = sigma.xy * F_xx - sigma.xx * H_yx;
          P_yx = sigma.xy * F_yy - sigma.yy * H_xy;
          P_yy = sigma.yy * F_xx - sigma.xy * H_yx;
        }

      V hg = all(0.5 * c.uniform_hourglass);
      if constexpr (softened != intact)
        hg = 0.5 * gather([&](unsigned int l) {
               return &a.hourglass[row.particle(l)];
             });
      scatter_records(row.to(a.gradient), row.n, H_xx, H_xy, H_yx, H_yy);
      V fit_xx = H_xx, fit_xy = H_xy, fit_yx = H_yx, fit_yy = H_yy;
      if constexpr (own_fit)
        {
          const V C_xx = gather(
              [&](unsigned int l) { return &a.fit[row.particle(l)].xx; });
          const V C_yy = gather(
              [&](unsigned int l) { return &a.fit[row.particle(l)].yy; });
          const V C_xy = gather(
              [&](unsigned int l) { return &a.fit[row.particle(l)].xy; });
          fit_xx = m_xx * C_xx + m_xy * C_xy;
          fit_xy = m_xx * C_xy + m_xy * C_yy;
          fit_yx = m_yx * C_xx + m_yy * C_xy;
          fit_yy = m_yx * C_xy + m_yy * C_yy;
        }
      scatter_records(row.to(a.pair_stress),
                      row.n,
                      P_xx * B_xx + P_xy * B_xy - hg * fit_xx,
                      P_xx * B_xy + P_xy * B_yy - hg * fit_xy,
                      P_yx * B_xx + P_yy * B_xy - hg * fit_yx,
                      P_yx * B_xy + P_yy * B_yy - hg * fit_yy);
    }


    template <bool linear_law, Softened softened, bool own_fit = false>
    void
    strain_loop(const BondedArrays    &a,
                const BondedConstants &c,
                const unsigned int     begin,
                const unsigned int     end)
    {
      for (unsigned int g = begin; g < end; ++g)
        {
          if constexpr (softened != intact)
            {
              a.crushed[g] = 0;
              if (a.slot_begin[g] == a.slot_end[g])
                continue;
            }
          for (unsigned int offset = 0; offset < group_size; offset += lanes)
            strain_row<linear_law, softened, own_fit>(a, c, g, offset);
        }
    }


    /// dv_i/dt = 1/rho_0 sum_j a_ij [(T_i + T_j) X_ij + k_ij u_ij], with
    /// T = P B - k_hg H / 2 and k_ij = (k_hg,i + k_hg,j) / 2: stress and
    /// the residual of the linear fit in one sweep. Every term changes but
    /// its sign when i and j are exchanged.
    template <bool viscosity, bool varying>
    MORSEL_INLINE void
    force_row(const BondedArrays    &a,
              const BondedConstants &c,
              const double           time_step,
              const unsigned int     g,
              const unsigned int     offset)
    {
      const Row row(a, g * group_size + offset);
      V         u_x, u_y, v_x, v_y, T_xx, T_xy, T_yx, T_yy;
      if constexpr (viscosity)
        gather_records(row.of(a.motion), u_x, u_y, v_x, v_y);
      else
        gather_pairs(row.of(a.motion), u_x, u_y);
      gather_records(row.of(a.pair_stress), T_xx, T_xy, T_yx, T_yy);
      V hg = all(c.uniform_hourglass);
      if constexpr (varying)
        hg = 0.5 * gather([&](unsigned int l) {
               return &a.hourglass[row.particle(l)];
             });

      const double       h     = c.smoothing_length;
      [[maybe_unused]] V alpha = all(c.viscosity_alpha_c);
      V                  f_x{}, f_y{};
      [[maybe_unused]] V g_x{}, g_y{}, power{};
      for (unsigned int s = a.slot_begin[g]; s < a.slot_end[g]; ++s)
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
              neighbours_in(a.pair_stress, index), S_xx, S_xy, S_yx, S_yy);
          du_x -= u_x;
          du_y -= u_y;
          V kij = hg;
          if constexpr (varying)
            kij += 0.5 * gather(neighbours_in(a.hourglass, index));
          f_x += w * ((T_xx + S_xx) * X + (T_xy + S_xy) * Y + kij * du_x);
          f_y += w * ((T_yx + S_yx) * X + (T_yy + S_yy) * Y + kij * du_y);

          if constexpr (viscosity)
            {
              // Pi_ij of T3-44 (sign corrected) along the current pair
              // direction, with the reference gradient's weight.
              const V r_x = X + du_x, r_y = Y + du_y;
              const V vr = smaller((dv_x - v_x) * r_x + (dv_y - v_y) * r_y,
                                   V{}); // approaching
              const V mu = h * vr / (r_x * r_x + r_y * r_y + 0.01 * h * h);
              const V q  = w * mu * (c.viscosity_beta * mu - alpha);
              g_x -= q * r_x;
              g_y -= q * r_y;
              power -= q * vr;
            }
        }

      const double inverse_density = 1. / c.density;
      V            a_x = inverse_density * f_x, a_y = inverse_density * f_y;
      if constexpr (viscosity)
        {
          a_x += g_x;
          a_y += g_y;
          // Half of each pair's power belongs to each of the two.
          power *= 0.5 * c.mass * time_step;
          for (unsigned int l = 0; l < lanes; ++l)
            if (l < row.n)
              a.viscous_heat[row.first + l] += power[l];
        }
      scatter_pairs(row.to(a.acceleration), row.n, a_x, a_y);
    }


    template <bool viscosity, bool varying>
    void
    force_loop(const BondedArrays    &a,
               const BondedConstants &c,
               const double           time_step,
               const unsigned int     begin,
               const unsigned int     end)
    {
      for (unsigned int g = begin; g < end; ++g)
        if (a.slot_begin[g] == a.slot_end[g])
          {
            for (unsigned int i = g * group_size;
                 i < (g + 1) * group_size && i < a.n_owned;
                 ++i)
              a.acceleration[i] = {0., 0.};
          }
        else
          for (unsigned int offset = 0; offset < group_size; offset += lanes)
            force_row<viscosity, varying>(a, c, time_step, g, offset);
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
