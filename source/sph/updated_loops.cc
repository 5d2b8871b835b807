#include <morsel/core/parallel.h>
#include <morsel/sph/updated_loops.h>

#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// Calls f<normalisation>() for one that is known at run time only.
    template <typename Function>
    void
    dispatch(const Normalisation normalisation, const Function &f)
    {
      using N = Normalisation;
      switch (normalisation)
        {
          case N::none:
            return f(std::integral_constant<N, N::none>());
          case N::shepard:
            return f(std::integral_constant<N, N::shepard>());
          case N::per_axis:
            return f(std::integral_constant<N, N::per_axis>());
          default:
            return f(std::integral_constant<N, N::gradient_matrix>());
        }
    }


    constexpr bool
    needs_moment(const Normalisation n)
    {
      return n == Normalisation::per_axis ||
             n == Normalisation::gradient_matrix;
    }


    /// Sum over the neighbours that the normalisation asks for, pair by pair.
    template <KernelKind kind, Normalisation normalisation>
    struct Sums
    {
      explicit Sums(const double own_area)
          : sums{{0., 0., 0.}, own_area * KernelShapes::value<kind>(0.)}
      {}

      void
      add(const double q,
          const double area,
          const double weighted, // area times |W'|/r
          const double x,
          const double y)
      {
        if constexpr (normalisation == Normalisation::shepard)
          sums.kernel += area * KernelShapes::value<kind>(q);
        if constexpr (needs_moment(normalisation))
          {
            sums.moment.xx += weighted * x * x;
            sums.moment.yy += weighted * y * y;
            sums.moment.xy += weighted * x * y;
          }
      }

      Symmetric2
      correction(const double h)
      {
        sums.kernel *= KernelShapes::normalisation(kind) / (h * h);
        return gradient_correction(normalisation, sums);
      }

      NeighbourSums sums;
    };


    template <KernelKind kind, Normalisation normalisation>
    void
    velocity_gradient_row(const UpdatedArrays    &a,
                          const UpdatedConstants &c,
                          const unsigned int      i,
                          Tensor2                *gradients)
    {
      const double inverse_h = 1. / c.h;
      const double scale     = KernelShapes::normalisation(kind) * inverse_h *
                           inverse_h * inverse_h * inverse_h;
      const Motion                     own = a.place[i];
      Tensor2                          L{0., 0., 0., 0.};
      Sums<kind, normalisation>        sums(a.area[i]);
      const std::vector<unsigned int> &start = a.neighbours->start;
      for (unsigned int k = start[i]; k < start[i + 1]; ++k)
        {
          const unsigned int j     = a.neighbours->index[k];
          const Motion       other = a.place[j];
          const double       x = other.u_x - own.u_x, y = other.u_y - own.u_y;
          const double       q = std::sqrt(x * x + y * y) * inverse_h;
          const double       w =
              a.area[j] * scale * KernelShapes::gradient_weight<kind>(q);
          const double v_x = w * (other.v_x - own.v_x);
          const double v_y = w * (other.v_y - own.v_y);
          L.xx += v_x * x;
          L.xy += v_x * y;
          L.yx += v_y * x;
          L.yy += v_y * y;
          sums.add(q, a.area[j], w, x, y);
        }
      if constexpr (normalisation != Normalisation::none)
        L = product(L, sums.correction(c.h));
      gradients[i] = L;
    }


    template <KernelKind kind, Normalisation normalisation>
    void
    geometry_row(const UpdatedArrays    &a,
                 const UpdatedConstants &c,
                 const unsigned int      i)
    {
      const double inverse_h = 1. / c.h;
      const double unit =
          KernelShapes::normalisation(kind) * inverse_h * inverse_h;
      const double                     scale = unit * inverse_h * inverse_h;
      const Motion                     own   = a.place[i];
      Sums<kind, normalisation>        sums(a.area[i]);
      const std::vector<unsigned int> &start = a.neighbours->start;
      for (unsigned int k = start[i]; k < start[i + 1]; ++k)
        {
          const unsigned int j     = a.neighbours->index[k];
          const Motion       other = a.place[j];
          const double       x = other.u_x - own.u_x, y = other.u_y - own.u_y;
          const double       q = std::sqrt(x * x + y * y) * inverse_h;
          const double       w = scale * KernelShapes::gradient_weight<kind>(q);
          a.weight[k]          = w;
          a.offset[k]          = {x, y};
          sums.add(q, a.area[j], a.area[j] * w, x, y);
          if (c.artificial_stress)
            a.closeness[k] = std::pow(c.closeness_scale * unit *
                                          KernelShapes::value<kind>(q),
                                      c.closeness_exponent);
        }
      a.shape[i] = sums.correction(c.h);
    }


    template <bool viscosity, bool artificial>
    void
    force_row(const UpdatedArrays    &a,
              const UpdatedConstants &c,
              const double            time_step,
              const unsigned int      i)
    {
      const Motion     own         = a.place[i];
      const PairStress T           = a.corrected_stress[i];
      const double     own_density = a.density[i];
      double           f_x = 0., f_y = 0.; // times rho_i
      double           g_x = 0., g_y = 0., viscous = 0., extra = 0.;
      const std::vector<unsigned int> &start = a.neighbours->start;
      for (unsigned int k = start[i]; k < start[i + 1]; ++k)
        {
          const unsigned int j = a.neighbours->index[k];
          const PairStress   S = a.corrected_stress[j];
          const double       x = a.offset[k].x, y = a.offset[k].y;
          const double       w = a.area[j] * a.weight[k];
          f_x += w * ((T.xx + S.xx) * x + (T.xy + S.xy) * y);
          f_y += w * ((T.yx + S.yx) * x + (T.yy + S.yy) * y);
          if constexpr (artificial)
            {
              const Symmetric2 &R  = a.artificial_stress[i];
              const Symmetric2 &Q  = a.artificial_stress[j];
              const double      wf = w * a.closeness[k];
              const double r_x   = wf * ((R.xx + Q.xx) * x + (R.xy + Q.xy) * y);
              const double r_y   = wf * ((R.xy + Q.xy) * x + (R.yy + Q.yy) * y);
              const Motion other = a.place[j];
              f_x += r_x;
              f_y += r_y;
              extra +=
                  r_x * (other.v_x - own.v_x) + r_y * (other.v_y - own.v_y);
            }
          if constexpr (viscosity)
            {
              // T3-44, the sign corrected; nothing between receding pairs.
              const Motion other = a.place[j];
              const double vr    = std::min(
                  (other.v_x - own.v_x) * x + (other.v_y - own.v_y) * y, 0.);
              const double mu = c.h * vr / (x * x + y * y + 0.01 * c.h * c.h);
              const double Pi = 2. * mu *
                                (c.viscosity_beta * mu - c.viscosity_alpha_c) /
                                (own_density + a.density[j]);
              const double p = a.mass_per_depth[j] * a.weight[k] * Pi;
              g_x -= p * x;
              g_y -= p * y;
              viscous -= p * vr;
            }
        }
      const double inverse = 1. / own_density;
      a.acceleration[i]    = {inverse * f_x + g_x, inverse * f_y + g_y};
      // Half of each pair's power belongs to each of the two.
      if constexpr (viscosity)
        a.viscous_heat[i] += 0.5 * a.mass[i] * time_step * viscous;
      if constexpr (artificial)
        a.artificial_heat[i] += 0.5 * a.mass[i] * time_step * inverse * extra;
    }


    template <typename Row>
    void
    for_rows(const UpdatedArrays &a, const Row &row)
    {
      parallel_for(a.neighbours->n_rows(),
                   [&](const unsigned int begin, const unsigned int end) {
                     for (unsigned int i = begin; i < end; ++i)
                       row(i);
                   });
    }
  } // namespace


  void
  sum_velocity_gradients(const UpdatedArrays    &a,
                         const UpdatedConstants &c,
                         Tensor2                *gradients)
  {
    KernelShapes::dispatch(c.kernel, [&](const auto kind) {
      dispatch(c.normalisation, [&](const auto normalisation) {
        for_rows(a, [&](const unsigned int i) {
          velocity_gradient_row<kind(), normalisation()>(a, c, i, gradients);
        });
      });
    });
  }


  void
  correct_geometry(const UpdatedArrays &a, const UpdatedConstants &c)
  {
    KernelShapes::dispatch(c.kernel, [&](const auto kind) {
      dispatch(c.normalisation, [&](const auto normalisation) {
        for_rows(a, [&](const unsigned int i) {
          geometry_row<kind(), normalisation()>(a, c, i);
        });
      });
    });
  }


  void
  sum_forces(const UpdatedArrays    &a,
             const UpdatedConstants &c,
             const double            time_step)
  {
    if (c.viscosity && c.artificial_stress)
      for_rows(a, [&](const unsigned int i) {
        force_row<true, true>(a, c, time_step, i);
      });
    else if (c.viscosity)
      for_rows(a, [&](const unsigned int i) {
        force_row<true, false>(a, c, time_step, i);
      });
    else if (c.artificial_stress)
      for_rows(a, [&](const unsigned int i) {
        force_row<false, true>(a, c, time_step, i);
      });
    else
      for_rows(a, [&](const unsigned int i) {
        force_row<false, false>(a, c, time_step, i);
      });
  }
} // namespace Morsel::SPH
