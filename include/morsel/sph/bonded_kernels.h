#ifndef morsel_sph_bonded_kernels_h
#define morsel_sph_bonded_kernels_h

// The first loop over bonded pairs, strain and stress, for groups of eight
// particles whose pairs stand side by side. Compiled once per instruction set.

#include <morsel/sph/lattice_kernels.h>

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

    /// How the displacement gradient is formed.
    enum class Gradient
    {
      fit,       ///< with the gradient matrix: a least-squares fit
      own_fit,   ///< with another matrix; the residual needs its own fit
      conforming ///< with weights G_ij as data, the residual with its own fit
    };

    struct Stress
    {
      V xx, yy, xy, zz;
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


    /// The matrices of a row that its kind of gradient takes.
    struct Corrections
    {
      Matrix shape, fit;
    };


    /// Where the particles of a row are, and from there their neighbours: what
    /// the conforming gradient reads of a pair comes from memory, which bounds
    /// its loops, so that positions are gathered; others have X_ij stored.
    template <Gradient kind>
    class Offsets
    {
    public:
      MORSEL_INLINE
      Offsets(const BondedArrays &a, const Row &row)
          : a(a)
      {
        if constexpr (kind == Gradient::conforming)
          gather_pairs(
              [&](const unsigned int l) {
                return a.reference + 2 * row.particle(l);
              },
              own_x,
              own_y);
      }

      /// X_j - X_i of the pairs at @p k.
      MORSEL_INLINE void
      get(const unsigned int k, V &X, V &Y) const
      {
        if constexpr (kind == Gradient::conforming)
          {
            gather_pairs(
                [&](const unsigned int l) {
                  return a.reference + 2 * a.index[k + l];
                },
                X,
                Y);
            X -= own_x;
            Y -= own_y;
          }
        else
          {
            X = load(a.dx + k);
            Y = load(a.dy + k);
          }
      }

    private:
      const BondedArrays &a;
      V                   own_x{}, own_y{};
    };


    /// The displacement gradient H; with the conforming gradient
    /// H = sum u_ij (x) G_ij + H_fit R with R = I - sum X_ij (x) G_ij, the
    /// least change that keeps linear fields exact once bonds are cut.
    template <Softened softened, Gradient kind>
    MORSEL_INLINE void
    displacement_gradient(const BondedArrays &a,
                          const Row          &row,
                          const unsigned int  g,
                          const unsigned int  offset,
                          const Corrections  &correction,
                          Matrix             &H,
                          Matrix             &fit)
    {
      V u_x, u_y;
      gather_pairs(row.of(a.motion), u_x, u_y);
      const Offsets<kind>     offsets(a, row);
      Matrix                  moment;
      [[maybe_unused]] Matrix sum;
      constexpr bool          conforming = kind == Gradient::conforming;
      const unsigned int near_end = conforming ? a.near_end[g] : a.slot_end[g];
      for (unsigned int s = a.slot_begin[g]; s < near_end; ++s)
        {
          const unsigned int k = s * group_size + offset;
          V                  du_x, du_y;
          gather_pairs(neighbours_in(a.motion, a.index + k), du_x, du_y);
          du_x -= u_x;
          du_y -= u_y;
          const V w = load(a.weight + k);
          V       X, Y;
          offsets.get(k, X, Y);
          moment.add(du_x, du_y, w * X, w * Y);
          if constexpr (conforming)
            sum.add(du_x, du_y, load(a.own_x + k), load(a.own_y + k));
        }
      if constexpr (conforming)
        for (unsigned int s = near_end; s < a.slot_end[g]; ++s)
          {
            const unsigned int k = s * group_size + offset;
            V                  du_x, du_y;
            gather_pairs(neighbours_in(a.motion, a.index + k), du_x, du_y);
            sum.add(
                du_x - u_x, du_y - u_y, load(a.own_x + k), load(a.own_y + k));
          }
      if constexpr (kind != Gradient::fit)
        fit = product(moment, correction.fit);
      if constexpr (kind != Gradient::conforming)
        H = product(moment, correction.shape);
      else if constexpr (softened == intact)
        H = sum;
      else
        {
          Matrix R;
          gather_records(row.of(a.deficit), R.xx, R.xy, R.yx, R.yy);
          const Matrix lost = product(fit, R);
          H                 = {sum.xx + lost.xx,
                               sum.xy + lost.xy,
                               sum.yx + lost.yx,
                               sum.yy + lost.yy};
        }
      if constexpr (kind == Gradient::fit)
        fit = H;
    }


    /// What the force loop gathers, see PairStress.
    /// @param modulus elastic moduli over the body's [1]
    template <Softened softened, Gradient kind>
    MORSEL_INLINE void
    store_pair_stress(const BondedArrays    &a,
                      const BondedConstants &c,
                      const Row             &row,
                      const Corrections     &correction,
                      const V                modulus,
                      const Matrix          &P,
                      const Matrix          &fit)
    {
      V hg = 0.5 * c.uniform_hourglass * modulus;
      if constexpr (softened != intact)
        hg = 0.5 * gather([&](unsigned int l) {
               return &a.hourglass[row.particle(l)];
             });
      Matrix T{}; // through the weights a_ij
      if constexpr (kind != Gradient::conforming)
        T = product(P, correction.shape);
      else
        {
          scatter_records(row.to(a.pair_stress), row.n, P.xx, P.xy, P.yx, P.yy);
          if constexpr (softened != intact)
            {
              Matrix R; // transposed
              gather_records(row.of(a.deficit), R.xx, R.yx, R.xy, R.yy);
              T = product(product(P, R), correction.fit);
            }
        }
      const Matrix S = {T.xx - hg * fit.xx,
                        T.xy - hg * fit.xy,
                        T.yx - hg * fit.yx,
                        T.yy - hg * fit.yy};
      if constexpr (kind == Gradient::conforming)
        scatter_records(row.to(a.fit_stress), row.n, S.xx, S.xy, S.yx, S.yy);
      else
        {
          const LatticeArrays &lattice = a.lattice;
          const char use = lattice.use ? lattice.use[row.first / group_size]
                                       : char(lattice_needs_records);
          if (use & lattice_needs_columns)
            {
              store(lattice.column[column_xx] + row.first, S.xx);
              store(lattice.column[column_xy] + row.first, S.xy);
              store(lattice.column[column_yx] + row.first, S.yx);
              store(lattice.column[column_yy] + row.first, S.yy);
            }
          if (use & lattice_needs_records)
            scatter_records(
                row.to(a.pair_stress), row.n, S.xx, S.xy, S.yx, S.yy);
        }
    }


    template <bool     linear_law,
              Softened softened,
              Gradient kind,
              Pairs    pairs = Pairs::list>
    MORSEL_INLINE void
    strain_row(const BondedArrays    &a,
               const BondedConstants &c,
               const unsigned int     g,
               const unsigned int     offset)
    {
      const Row row(a, g * group_size + offset);

      Corrections correction;
      Matrix      H, fit;
      if constexpr (pairs != Pairs::list)
        {
          const Symmetric2 &B = a.lattice.shape;
          if constexpr (pairs == Pairs::regular)
            correction.shape = {all(B.xx), all(B.xy), all(B.xy), all(B.yy)};
          else
            correction.shape = symmetric_of(row, a.shape);
          H   = product(lattice_moment<pairs>(a, g, offset), correction.shape);
          fit = H;
        }
      else
        {
          if constexpr (kind != Gradient::conforming)
            correction.shape = symmetric_of(row, a.shape);
          if constexpr (kind != Gradient::fit)
            correction.fit = symmetric_of(row, a.fit);
          displacement_gradient<softened, kind>(
              a, row, g, offset, correction, H, fit);
        }
      const V H_xx = H.xx, H_xy = H.xy, H_yx = H.yx, H_yy = H.yy;
      const V F_xx = 1. + H_xx, F_yy = 1. + H_yy;

      const V modulus = a.modulus ? gather([&](unsigned int l) {
        return &a.modulus[row.particle(l)];
      })
                                  : all(1.);
      const V mu = c.mu * modulus, bulk = c.bulk * modulus;
      Stress  deviator;
      V       mean;
      if constexpr (linear_law)
        {
          const V tr = H_xx + H_yy, third = tr / 3.;
          deviator = {2. * mu * (H_xx - third),
                      2. * mu * (H_yy - third),
                      mu * (H_xy + H_yx),
                      -2. * mu * third};
          mean     = bulk * tr;
        }
      else
        {
          const V J         = F_xx * F_yy - H_xy * H_yx;
          const V inverse_J = 1. / J;
          const V b_xx      = F_xx * F_xx + H_xy * H_xy;
          const V b_yy      = H_yx * H_yx + F_yy * F_yy;
          const V b_xy      = F_xx * H_yx + H_xy * F_yy;
          const V third     = (b_xx + b_yy + 1.) * (1. / 3.);
          const V factor    = mu * power_minus_two_thirds(J) * inverse_J;
          deviator          = {factor * (b_xx - third),
                               factor * (b_yy - third),
                               factor * b_xy,
                               factor * (1. - third)};
          mean              = 0.5 * bulk * (J - inverse_J);
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

      scatter_records(row.to(a.gradient), row.n, H_xx, H_xy, H_yx, H_yy);
      store_pair_stress<softened, kind>(
          a, c, row, correction, modulus, {P_xx, P_xy, P_yx, P_yy}, fit);
    }


    template <bool linear_law, Softened softened, Gradient kind = Gradient::fit>
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
              if (is_retired(a, g))
                continue;
            }
          const Pairs pairs =
              kind == Gradient::fit ? pairs_of(a, g) : Pairs::list;
          for (unsigned int offset = 0; offset < group_size; offset += lanes)
            if constexpr (kind != Gradient::fit)
              strain_row<linear_law, softened, kind>(a, c, g, offset);
            else if (pairs == Pairs::regular)
              strain_row<linear_law, softened, kind, Pairs::regular>(
                  a, c, g, offset);
            else if (pairs == Pairs::frayed)
              strain_row<linear_law, softened, kind, Pairs::frayed>(
                  a, c, g, offset);
            else
              strain_row<linear_law, softened, kind>(a, c, g, offset);
        }
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
