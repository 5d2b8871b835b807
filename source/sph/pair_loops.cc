#include <morsel/sph/pair_loops.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using Materials::Tensor2;

  Tensor2
  displacement_gradient(const Particles   &p,
                        const Bonds       &bonds,
                        const unsigned int i)
  {
    const double u_x = p.motion[i].u_x, u_y = p.motion[i].u_y;
    Tensor2      m{0., 0., 0., 0.};
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const Motion &j    = p.motion[bonds.list.index[k]];
        const double  ax   = bonds.weight[k] * bonds.dx[k];
        const double  ay   = bonds.weight[k] * bonds.dy[k];
        const double  du_x = j.u_x - u_x, du_y = j.u_y - u_y;
        m.xx += du_x * ax;
        m.xy += du_x * ay;
        m.yx += du_y * ax;
        m.yy += du_y * ay;
      }
    const Symmetric2 B = p.shape[i];
    return {m.xx * B.xx + m.xy * B.xy,
            m.xx * B.xy + m.xy * B.yy,
            m.yx * B.xx + m.yy * B.xy,
            m.yx * B.xy + m.yy * B.yy};
  }


  namespace
  {

    Tensor2
    deformation_gradient(const Tensor2 &H)
    {
      return {1. + H.xx, H.xy, H.yx, 1. + H.yy};
    }


    template <bool linear_law, bool damage>
    void
    strain_loop(Particles           &p,
                const Bonds         &bonds,
                const LoopConstants &c,
                const unsigned int   begin,
                const unsigned int   end)
    {
      for (unsigned int i = begin; i < end; ++i)
        {
          if constexpr (damage)
            if (p.failed[i])
              continue;

          const Tensor2                H = displacement_gradient(p, bonds, i);
          const Tensor2                F = deformation_gradient(H);
          const auto                   response = linear_law
                                                      ? Materials::linear_elastic(c.material, F)
                                                      : Materials::neo_hookean(c.material, F);
          Materials::PlaneStrainStress sigma    = {
                 response.deviator.xx + response.mean,
                 response.deviator.yy + response.mean,
                 response.deviator.xy,
                 response.deviator.zz + response.mean};
          if constexpr (damage)
            {
              p.effective[i] = sigma;
              if (p.damage[i] > 0.)
                sigma = Materials::soften(c.softening, response, p.damage[i]);
            }
          const Tensor2 P =
              linear_law ? Tensor2{sigma.xx, sigma.xy, sigma.xy, sigma.yy}
                         : Materials::piola(F, sigma);

          const Symmetric2 B  = p.shape[i];
          const double     hg = 0.5 * p.hourglass[i];
          p.gradient[i]       = H;
          p.pair_stress[i]    = {P.xx * B.xx + P.xy * B.xy - hg * H.xx,
                                 P.xx * B.xy + P.xy * B.yy - hg * H.xy,
                                 P.yx * B.xx + P.yy * B.xy - hg * H.yx,
                                 P.yx * B.xy + P.yy * B.yy - hg * H.yy};
        }
    }


    /// dv_i/dt = 1/rho_0 sum_j a_ij [(T_i + T_j) X_ij + k_ij u_ij], with
    /// T = P B - k_hg H / 2 and k_ij = (k_hg,i + k_hg,j) / 2: stress and
    /// the residual of the linear fit in one sweep.
    template <bool viscosity>
    void
    force_loop(Particles                            &p,
               const Bonds                          &bonds,
               [[maybe_unused]] const LoopConstants &c,
               [[maybe_unused]] const double         time_step,
               const unsigned int                    begin,
               const unsigned int                    end)
    {
      const double                  inverse_density = 1. / c.material.density;
      [[maybe_unused]] const double h               = c.smoothing_length;
      for (unsigned int i = begin; i < end; ++i)
        {
          const Motion            a   = p.motion[i];
          const PairStress        T   = p.pair_stress[i];
          const double            hg  = p.hourglass[i];
          double                  f_x = 0., f_y = 0.;
          [[maybe_unused]] double g_x = 0., g_y = 0., power = 0.;
          for (unsigned int k = bonds.list.start[i];
               k < bonds.list.start[i + 1];
               ++k)
            {
              const unsigned int j = bonds.list.index[k];
              const Motion      &b = p.motion[j];
              const PairStress  &S = p.pair_stress[j];
              const double       w = bonds.weight[k];
              const double       X = bonds.dx[k], Y = bonds.dy[k];
              const double       du_x = b.u_x - a.u_x, du_y = b.u_y - a.u_y;
              const double       kij = 0.5 * (hg + p.hourglass[j]);
              f_x += w * ((T.xx + S.xx) * X + (T.xy + S.xy) * Y + kij * du_x);
              f_y += w * ((T.yx + S.yx) * X + (T.yy + S.yy) * Y + kij * du_y);

              if constexpr (viscosity)
                {
                  // Pi_ij of T3-44 (sign corrected) along the current pair
                  // direction, with the reference gradient's weight.
                  const double r_x = X + du_x, r_y = Y + du_y;
                  const double v_x = b.v_x - a.v_x, v_y = b.v_y - a.v_y;
                  const double vr =
                      std::min(0., v_x * r_x + v_y * r_y); // approaching
                  const double r2 = r_x * r_x + r_y * r_y;
                  const double mu = h * vr / (r2 + 0.01 * h * h);
                  const double q  = w * mu *
                                   (c.viscosity_beta * mu -
                                    c.viscosity_alpha * c.material.wave_speed);
                  g_x -= q * r_x;
                  g_y -= q * r_y;
                  power -= q * vr;
                }
            }
          p.acceleration[i] = {inverse_density * f_x, inverse_density * f_y};
          if constexpr (viscosity)
            {
              p.acceleration[i].x += g_x;
              p.acceleration[i].y += g_y;
              // Half of each pair's power belongs to each of the two.
              p.viscous_heat[i] += 0.5 * p.mass * power * time_step;
            }
        }
    }
  } // namespace


  StrainLoop
  choose_strain_loop(const bool linear_law, const bool damage)
  {
    return linear_law
               ? (damage ? strain_loop<true, true> : strain_loop<true, false>)
               : (damage ? strain_loop<false, true>
                         : strain_loop<false, false>);
  }


  ForceLoop
  choose_force_loop(const bool viscosity)
  {
    return viscosity ? force_loop<true> : force_loop<false>;
  }


  Materials::ElasticResponse
  response_at(const Particles             &p,
              const Materials::Elasticity &material,
              const bool                   linear_law,
              const unsigned int           i)
  {
    const Tensor2 F = deformation_gradient(p.gradient[i]);
    return linear_law ? Materials::linear_elastic(material, F)
                      : Materials::neo_hookean(material, F);
  }


  double
  fit_residual(const Particles &p, const Bonds &bonds, const unsigned int i)
  {
    const Tensor2 &H   = p.gradient[i];
    double         sum = 0.;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const Motion &j = p.motion[bonds.list.index[k]];
        const double  X = bonds.dx[k], Y = bonds.dy[k];
        const double  e_x = j.u_x - p.motion[i].u_x - H.xx * X - H.xy * Y;
        const double  e_y = j.u_y - p.motion[i].u_y - H.yx * X - H.yy * Y;
        sum += bonds.weight[k] * (e_x * e_x + e_y * e_y);
      }
    return 0.25 * p.volume * sum;
  }
} // namespace Morsel::SPH
