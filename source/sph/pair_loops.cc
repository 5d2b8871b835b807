#include <morsel/sph/pair_loops.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using Materials::Tensor2;

  BondedArrays
  bonded_arrays(Particles &p, Bonds &bonds)
  {
    const PackedBonds  &b       = bonds.packed;
    const double *const modulus = p.modulus.empty() ? nullptr : &p.modulus[0];
    LatticeArrays       lattice;
    bonds.lattice.describe(lattice);
    return {b.slot_begin.data(),
            b.slot_end.data(),
            b.near_end.data(),
            b.weight.data(),
            b.dx.data(),
            b.dy.data(),
            b.average.data(),
            b.index.data(),
            p.n_owned,
            p.reference.empty() ? nullptr : p.reference.front().begin_raw(),
            p.motion.data(),
            p.shape.data(),
            p.hourglass.data(),
            p.damage.data(),
            p.near_face.data(),
            p.gradient.data(),
            p.pair_stress.data(),
            p.effective.data(),
            p.acceleration.data(),
            p.viscous.data(),
            p.driver.data(),
            p.crushed.data(),
            p.strongest.data(),
            p.fit.data(),
            p.mass.data(),
            b.own_x.data(),
            b.own_y.data(),
            b.back_x.data(),
            b.back_y.data(),
            b.damping.data(),
            p.own_sum.data(),
            p.deficit.data(),
            p.fit_stress.data(),
            modulus,
            p.failed.data(),
            p.energy.data(),
            lattice};
  }


  void
  renew_conforming(Particles &p, const Bonds &bonds, const unsigned int i)
  {
    p.fit[i]     = inverse(bonds.moment(p, i));
    p.own_sum[i] = bonds.gradient_sum(i);
    if (p.deficit.empty())
      return;
    const Tensor2 G = bonds.gradient_moment(p, i);
    p.deficit[i]    = {1. - G.xx, -G.xy, -G.yx, 1. - G.yy};
  }


  namespace
  {
    /// Displacement now, or after the coming leapfrog step.
    struct Displacement
    {
      double step; ///< [s], 0: now

      Vector2
      operator()(const Particles &p, const unsigned int i) const
      {
        const Vector2 u{p.motion[i].u_x, p.motion[i].u_y};
        if (step == 0.)
          return u;
        const Vector2 v = p.half_velocity[i], a = p.acceleration[i];
        return {u.x + step * (v.x + step * a.x),
                u.y + step * (v.y + step * a.y)};
      }
    };


    Vector2
    velocity(const Particles &p, const unsigned int i)
    {
      return {p.motion[i].v_x, p.motion[i].v_y};
    }


    /// sum_j v_ij (x) g_ij of a field v.
    template <typename Field, typename Weight>
    Tensor2
    moment(const Particles   &p,
           const Bonds       &bonds,
           const unsigned int i,
           const Field       &field,
           const Weight      &weight)
    {
      const Vector2 own = field(p, i);
      Tensor2       m{0., 0., 0., 0.};
      for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
           ++k)
        {
          const Vector2 v  = field(p, bonds.list.index[k]);
          const Vector2 g  = weight(k);
          const double  dx = v.x - own.x, dy = v.y - own.y;
          m.xx += dx * g.x;
          m.xy += dx * g.y;
          m.yx += dy * g.x;
          m.yy += dy * g.y;
        }
      return m;
    }


    /// sum_j a_ij v_ij (x) X_ij.
    template <typename Field>
    Tensor2
    weighted_moment(const Particles   &p,
                    const Bonds       &bonds,
                    const unsigned int i,
                    const Field       &field)
    {
      return moment(p, bonds, i, field, [&](const unsigned int k) {
        const Vector2 X = bonds.offset(p, i, k);
        return Vector2{bonds.weight[k] * X.x, bonds.weight[k] * X.y};
      });
    }


    /// The gradient of a field as the body's strain sees it.
    template <typename Field>
    Tensor2
    gradient(const Particles   &p,
             const Bonds       &bonds,
             const unsigned int i,
             const Field       &field)
    {
      if (!bonds.is_conforming())
        return product(weighted_moment(p, bonds, i, field), p.shape[i]);
      Tensor2 H = moment(p, bonds, i, field, [&](const unsigned int k) {
        return bonds.own[k];
      });
      if (!p.deficit.empty())
        {
          const Tensor2 fit =
              product(weighted_moment(p, bonds, i, field), p.fit[i]);
          const Tensor2 &R = p.deficit[i];
          H.xx += fit.xx * R.xx + fit.xy * R.yx;
          H.xy += fit.xx * R.xy + fit.xy * R.yy;
          H.yx += fit.yx * R.xx + fit.yy * R.yx;
          H.yy += fit.yx * R.xy + fit.yy * R.yy;
        }
      return H;
    }
  } // namespace


  Tensor2
  displacement_gradient(const Particles   &p,
                        const Bonds       &bonds,
                        const unsigned int i,
                        const double       ahead)
  {
    return gradient(p, bonds, i, Displacement{ahead});
  }


  Tensor2
  rate_of_gradient(const Particles &p, const Bonds &bonds, const unsigned int i)
  {
    return gradient(p, bonds, i, velocity);
  }


  namespace
  {
    Tensor2
    deformation_gradient(const Tensor2 &H)
    {
      return {1. + H.xx, H.xy, H.yx, 1. + H.yy};
    }
  } // namespace


  Materials::ElasticResponse
  response_to(const Tensor2               &H,
              const Materials::Elasticity &material,
              const bool                   linear_law)
  {
    const Tensor2 F = deformation_gradient(H);
    return linear_law ? Materials::linear_elastic(material, F)
                      : Materials::neo_hookean(material, F);
  }


  Materials::ElasticResponse
  response_at(const Particles             &p,
              const Materials::Elasticity &material,
              const bool                   linear_law,
              const unsigned int           i)
  {
    return response_to(p.gradient[i], material, linear_law);
  }


  double
  fit_residual(const Particles   &p,
               const Bonds       &bonds,
               const unsigned int i,
               const double       ahead)
  {
    const Displacement displacement{ahead};
    const Tensor2      H =
        p.fit.empty()
                 ? (ahead == 0. ? p.gradient[i]
                                : displacement_gradient(p, bonds, i, ahead))
                 : product(weighted_moment(p, bonds, i, displacement), p.fit[i]);
    const Vector2 own = displacement(p, i);
    double        sum = 0.;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const Vector2 u   = displacement(p, bonds.list.index[k]);
        const Vector2 X   = bonds.offset(p, i, k);
        const double  e_x = u.x - own.x - H.xx * X.x - H.xy * X.y;
        const double  e_y = u.y - own.y - H.yx * X.x - H.yy * X.y;
        sum += bonds.weight[k] * (e_x * e_x + e_y * e_y);
      }
    return 0.25 * p.volume(i) * sum;
  }


  namespace
  {
    /// Sums over the bonds of a particle for a least-squares fit.
    struct FitSums
    {
      Tensor2 moment{0., 0., 0., 0.}; ///< sum_j a_ij u_ij (x) X_ij
      double  square = 0.;            ///< sum_j a_ij u_ij . u_ij

      void
      add(const double w,
          const double u_x,
          const double u_y,
          const double X,
          const double Y)
      {
        moment.xx += w * u_x * X;
        moment.xy += w * u_x * Y;
        moment.yx += w * u_y * X;
        moment.yy += w * u_y * Y;
        square += w * (u_x * u_x + u_y * u_y);
      }

      /// sum_j a_ij |u_ij - H X_ij|^2 with C = sum_j a_ij X_ij (x) X_ij.
      double
      residual(const Tensor2 &H, const Symmetric2 &C) const
      {
        const Tensor2 HC = product(H, C);
        return square + H.xx * (HC.xx - 2. * moment.xx) +
               H.xy * (HC.xy - 2. * moment.xy) +
               H.yx * (HC.yx - 2. * moment.yx) +
               H.yy * (HC.yy - 2. * moment.yy);
      }
    };
  } // namespace


  std::array<LocalStrain, 2>
  strain_over_step(const Particles   &p,
                   const Bonds       &bonds,
                   const unsigned int i,
                   const double       step)
  {
    if (!p.fit.empty())
      return {{{p.gradient[i], fit_residual(p, bonds, i)},
               {displacement_gradient(p, bonds, i, step),
                fit_residual(p, bonds, i, step)}}};

    const Displacement ahead{step};
    const Motion       m    = p.motion[i];
    const Vector2      then = ahead(p, i);
    Symmetric2         C{0., 0., 0.};
    FitSums            sums_now, sums_then;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const unsigned int j = bonds.list.index[k];
        const auto [X, Y]    = bonds.offset(p, i, k);
        const double  w      = bonds.weight[k];
        const Vector2 u      = ahead(p, j);
        C.xx += w * X * X;
        C.yy += w * Y * Y;
        C.xy += w * X * Y;
        sums_now.add(w, p.motion[j].u_x - m.u_x, p.motion[j].u_y - m.u_y, X, Y);
        sums_then.add(w, u.x - then.x, u.y - then.y, X, Y);
      }
    const Tensor2 H      = product(sums_then.moment, p.shape[i]);
    const double  factor = 0.25 * p.volume(i);
    return {{{p.gradient[i], factor * sums_now.residual(p.gradient[i], C)},
             {H, factor * sums_then.residual(H, C)}}};
  }
} // namespace Morsel::SPH
