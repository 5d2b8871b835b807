#ifndef morsel_sph_grain_kernels_h
#define morsel_sph_grain_kernels_h

// The two loops over pairs with a grain: a group of rows at a time, one pair of
// each in every slot. Compiled once per instruction set.

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


    /// Forces on the rows of a group from @p offset on, one row a lane.
    template <bool wendland>
    MORSEL_INLINE void
    force_on_rows(const GrainArrays    &a,
                  const GrainConstants &c,
                  const unsigned int    g,
                  const unsigned int    offset,
                  GrainForce           *sums)
    {
      const unsigned int *const rows = a.row + g * group_size + offset;
      V own_x, own_y, own_v_x, own_v_y, own_xx, own_yy, own_xy, own_area;
      V own_diameter, own_reference_area;
      gather_records(
          neighbours_in(a.motion, rows), own_x, own_y, own_v_x, own_v_y);
      gather_records(
          neighbours_in(a.stress, rows), own_xx, own_yy, own_xy, own_area);
      gather_pairs(
          neighbours_in(a.size, rows), own_diameter, own_reference_area);
      const V own_mass = gather(neighbours_in(a.mass, rows));
      // V_i V_j (sigma_i + sigma_j) grad W between grains;
      // V_i V_j 2 sigma grad W where one of the two is live.
      const V share = own_area > 0. ? all(1.) : all(2.);
      own_area      = own_area > 0. ? own_area : -own_area;
      const V alpha = all(c.viscosity_alpha_c);
      V       f_x{}, f_y{}, g_x{}, g_y{}, pressed{};
      for (unsigned int s = a.slot_begin[g]; s < a.slot_begin[g + 1]; ++s)
        {
          const unsigned int *j = a.index + s * group_size + offset;
          V                   r_x, r_y, v_x, v_y, s_xx, s_yy, s_xy, area;
          gather_records(neighbours_in(a.motion, j), r_x, r_y, v_x, v_y);
          r_x -= own_x;
          r_y -= own_y;
          const V r2 = r_x * r_x + r_y * r_y;
          if (!any(r2 < c.support_square))
            continue;
          gather_records(neighbours_in(a.stress, j), s_xx, s_yy, s_xy, area);
          v_x -= own_v_x;
          v_y -= own_v_y;
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

          const V factor = area > 0. ? share : all(2.);
          const V w      = factor * (c.thickness * weight) *
                      (own_area * (area > 0. ? area : -area));

          const V gap    = smaller(r - smaller(diameter, own_diameter), V{});
          const V radial = c.contact_stiffness * gap * inverse_r;
          pressed += gap * gap;

          f_x += w * ((own_xx + s_xx) * r_x + (own_xy + s_xy) * r_y) +
                 radial * r_x;
          f_y += w * ((own_xy + s_xy) * r_x + (own_yy + s_yy) * r_y) +
                 radial * r_y;
        }
      f_x += g_x;
      f_y += g_y;
      pressed = 0.5 * c.contact_stiffness * pressed;
      for (unsigned int l = 0; l < lanes; ++l)
        if (g * group_size + offset + l < a.n_rows)
          sums[rows[l] - a.first_row] = {
              f_x[l], f_y[l], g_x[l], g_y[l], pressed[l]};
    }


    template <bool wendland>
    void
    grain_force(const GrainArrays &a, const GrainConstants &c, GrainForce *sums)
    {
      for (unsigned int g = 0; g * group_size < a.n_rows; ++g)
        for (unsigned int offset = 0; offset < group_size; offset += lanes)
          force_on_rows<wendland>(a, c, g, offset, sums);
    }


    /// L_i = sum_j V_j v_ij (x) grad W of the rows of a group.
    template <bool wendland>
    MORSEL_INLINE void
    rates_of_rows(const GrainArrays    &a,
                  const GrainConstants &c,
                  const unsigned int    g,
                  const unsigned int    offset,
                  Materials::Tensor2   *sums)
    {
      const unsigned int *const rows = a.row + g * group_size + offset;
      V                         own_x, own_y, own_v_x, own_v_y;
      gather_records(
          neighbours_in(a.motion, rows), own_x, own_y, own_v_x, own_v_y);
      V L_xx{}, L_xy{}, L_yx{}, L_yy{};
      for (unsigned int s = a.slot_begin[g]; s < a.slot_begin[g + 1]; ++s)
        {
          const unsigned int *j = a.index + s * group_size + offset;
          V                   r_x, r_y, v_x, v_y;
          gather_records(neighbours_in(a.motion, j), r_x, r_y, v_x, v_y);
          r_x -= own_x;
          r_y -= own_y;
          const V r2 = r_x * r_x + r_y * r_y + 1e-300;
          const V r  = square_root(r2);
          const V w  = gather(neighbours_in(a.area, j)) *
                      gradient_weight<wendland>(c, r, 1. / r);
          v_x = w * (v_x - own_v_x);
          v_y = w * (v_y - own_v_y);
          L_xx += v_x * r_x;
          L_xy += v_x * r_y;
          L_yx += v_y * r_x;
          L_yy += v_y * r_y;
        }
      for (unsigned int l = 0; l < lanes; ++l)
        if (g * group_size + offset + l < a.n_rows)
          sums[rows[l] - a.first_row] = {L_xx[l], L_xy[l], L_yx[l], L_yy[l]};
    }


    template <bool wendland>
    void
    grain_rate(const GrainArrays    &a,
               const GrainConstants &c,
               Materials::Tensor2   *sums)
    {
      for (unsigned int g = 0; g * group_size < a.n_grains; ++g)
        for (unsigned int offset = 0; offset < group_size; offset += lanes)
          rates_of_rows<wendland>(a, c, g, offset, sums);
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
