#ifndef morsel_sph_grain_kernels_h
#define morsel_sph_grain_kernels_h

// The two loops over pairs with a grain: along one row at a time, as many
// pairs as there are lanes. Compiled once per instruction set.

#include <morsel/sph/pair_kernels.h>
#include <morsel/sph/vector_lanes.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// -W'(r)/r, see Kernel::gradient_weight(); zero beyond the support.
    template <bool wendland>
    MORSEL_INLINE V
    gradient_weight(const GrainConstants &c, const V r, const V inverse_r)
    {
      const double scale = c.normalisation / (c.h * c.h);
      const V      q     = r * (1. / c.h);
      if constexpr (wendland)
        {
          const V t = larger(1. - 0.5 * q, V{});
          return (5. * scale) * (t * t * t);
        }
      else
        {
          const V t = larger(2. - q, V{});
          return scale *
                 (q < 1. ? 2. - 1.5 * q : 0.5 * c.h * (t * t * inverse_r));
        }
    }


    template <bool wendland>
    MORSEL_INLINE GrainForce
    force_on_row(const GrainArrays    &a,
                 const GrainConstants &c,
                 const unsigned int    n,
                 const unsigned int    m)
    {
      const GrainMotion own        = a.motion[m];
      const GrainStress own_stress = a.stress[m];
      const bool        is_grain   = own_stress.signed_area > 0.;
      const double      own_area   = __builtin_fabs(own_stress.signed_area);
      const GrainSize   own_size   = a.size[m];
      const double      own_mass   = a.mass[m];
      const V           alpha      = all(c.viscosity_alpha_c);
      V                 f_x{}, f_y{}, g_x{}, g_y{}, pressed{};
      for (unsigned int k = a.start[n]; k < a.start[n + 1]; k += lanes)
        {
          const unsigned int *j = a.index + k;
          V                   r_x, r_y, v_x, v_y, s_xx, s_yy, s_xy, area;
          gather_records(neighbours_in(a.motion, j), r_x, r_y, v_x, v_y);
          r_x -= own.x;
          r_y -= own.y;
          const V r2 = r_x * r_x + r_y * r_y;
          if (!any(r2 < c.support_square))
            continue;
          gather_records(neighbours_in(a.stress, j), s_xx, s_yy, s_xy, area);
          v_x -= own.v_x;
          v_y -= own.v_y;
          const V r         = square_root(r2 + 1e-300);
          const V inverse_r = 1. / r;
          const V weight    = gradient_weight<wendland>(c, r, inverse_r);

          // Viscosity (T3-44, sign corrected) of whatever approaches.
          const V vr = smaller(v_x * r_x + v_y * r_y, V{});
          const V mu = c.h * vr / (r2 + 0.01 * c.h * c.h);
          V       diameter, reference_area;
          gather_pairs(neighbours_in(a.size, j), diameter, reference_area);
          const V q = own_mass * ((reference_area * weight) * mu *
                                  (c.viscosity_beta * mu - alpha));
          g_x -= q * r_x;
          g_y -= q * r_y;

          // V_i V_j (sigma_i + sigma_j) grad W between grains;
          // V_i V_j 2 sigma grad W where one of the two is live.
          const V factor = is_grain ? (area > 0. ? all(1.) : all(2.)) : all(2.);
          const V w      = factor * (c.thickness * weight) *
                      (own_area * (area > 0. ? area : -area));

          const V gap =
              smaller(r - smaller(diameter, all(own_size.diameter)), V{});
          const V radial = c.contact_stiffness * gap * inverse_r;
          pressed += gap * gap;

          f_x += w * ((own_stress.xx + s_xx) * r_x +
                      (own_stress.xy + s_xy) * r_y) +
                 radial * r_x;
          f_y += w * ((own_stress.xy + s_xy) * r_x +
                      (own_stress.yy + s_yy) * r_y) +
                 radial * r_y;
        }
      const double viscous_x = sum(g_x), viscous_y = sum(g_y);
      return {sum(f_x) + viscous_x,
              sum(f_y) + viscous_y,
              viscous_x,
              viscous_y,
              0.5 * c.contact_stiffness * sum(pressed)};
    }


    template <bool wendland>
    void
    grain_force(const GrainArrays &a, const GrainConstants &c, GrainForce *sums)
    {
      for (unsigned int n = 0; n < a.n_rows; ++n)
        sums[n] = force_on_row<wendland>(a, c, n, a.first_row + n);
    }


    /// L_i = sum_j V_j v_ij (x) grad W of the grains among the rows.
    template <bool wendland>
    void
    grain_rate(const GrainArrays    &a,
               const GrainConstants &c,
               Materials::Tensor2   *sums)
    {
      for (unsigned int n = 0; n < a.n_rows; ++n)
        {
          if (!a.is_grain[a.first_row + n])
            continue;
          const GrainMotion own = a.motion[a.first_row + n];
          V                 L_xx{}, L_xy{}, L_yx{}, L_yy{};
          for (unsigned int k = a.start[n]; k < a.start[n + 1]; k += lanes)
            {
              const unsigned int *j = a.index + k;
              V                   r_x, r_y, v_x, v_y;
              gather_records(neighbours_in(a.motion, j), r_x, r_y, v_x, v_y);
              r_x -= own.x;
              r_y -= own.y;
              const V r2 = r_x * r_x + r_y * r_y + 1e-300;
              const V r  = square_root(r2);
              const V w  = gather(neighbours_in(a.area, j)) *
                          gradient_weight<wendland>(c, r, 1. / r);
              v_x = w * (v_x - own.v_x);
              v_y = w * (v_y - own.v_y);
              L_xx += v_x * r_x;
              L_xy += v_x * r_y;
              L_yx += v_y * r_x;
              L_yy += v_y * r_y;
            }
          sums[n] = {sum(L_xx), sum(L_xy), sum(L_yx), sum(L_yy)};
        }
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
