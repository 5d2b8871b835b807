#ifndef morsel_sph_softening_kernels_h
#define morsel_sph_softening_kernels_h

// Energy softening of a group of particles whose gradient is a least-squares
// fit and whose deviator softens. Compiled once per instruction set.

#include <morsel/sph/driver_kernels.h>
#include <morsel/sph/energy_kernels.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// Sums over the pairs of a row of particles for a least-squares fit.
    struct FitSums
    {
      Matrix moment;   ///< sum_j a_ij u_ij (x) X_ij
      V      square{}; ///< sum_j a_ij u_ij . u_ij

      MORSEL_INLINE void
      add(const V w, const V u_x, const V u_y, const V w_X, const V w_Y)
      {
        moment.add(u_x, u_y, w_X, w_Y);
        square += w * (u_x * u_x + u_y * u_y);
      }

      /// sum_j a_ij |u_ij - H X_ij|^2 with C = sum_j a_ij X_ij (x) X_ij.
      MORSEL_INLINE V
      residual(const Matrix &H, const Matrix &C) const
      {
        const Matrix HC = product(H, C);
        return square + H.xx * (HC.xx - 2. * moment.xx) +
               H.xy * (HC.xy - 2. * moment.xy) +
               H.yx * (HC.yx - 2. * moment.yx) +
               H.yy * (HC.yy - 2. * moment.yy);
      }
    };


    /// What damage takes away, for elastic moduli of the body [J/m^3].
    struct Releasable
    {
      V now;  ///< of what is stored now
      V mean; ///< now and after the coming step, with the hourglass control's
    };


    template <bool linear_law>
    MORSEL_INLINE Releasable
    releasable_energy(const BondedArrays    &a,
                      const BondedConstants &c,
                      const GroupSoftening  &s,
                      const Row             &row,
                      const unsigned int     g,
                      const unsigned int     offset)
    {
      const V    step = all(s.time_step);
      const auto after =
          [&](const auto &index, V &u_x, V &u_y, V &then_x, V &then_y) {
            V v_x, v_y, a_x, a_y;
            gather_pairs(index(a.motion), u_x, u_y);
            gather_pairs(index(s.half_velocity), v_x, v_y);
            gather_pairs(index((const Vector2 *)a.acceleration), a_x, a_y);
            then_x = u_x + step * (v_x + step * a_x);
            then_y = u_y + step * (v_y + step * a_y);
          };
      V u_x, u_y, then_x, then_y;
      after([&](const auto *records) { return row.of(records); },
            u_x,
            u_y,
            then_x,
            then_y);
      Matrix  C;
      FitSums now, then;
      for (unsigned int slot = a.slot_begin[g]; slot < a.slot_end[g]; ++slot)
        {
          const unsigned int k = slot * group_size + offset;
          V                  du_x, du_y, dthen_x, dthen_y;
          after(
              [&](const auto *records) {
                return neighbours_in(records, a.index + k);
              },
              du_x,
              du_y,
              dthen_x,
              dthen_y);
          const V w = load(a.weight + k), X = load(a.dx + k),
                  Y   = load(a.dy + k);
          const V w_X = w * X, w_Y = w * Y;
          C.add(X, Y, w_X, w_Y);
          now.add(w, du_x - u_x, du_y - u_y, w_X, w_Y);
          then.add(w, dthen_x - then_x, dthen_y - then_y, w_X, w_Y);
        }
      Matrix H;
      gather_records(row.of(a.gradient), H.xx, H.xy, H.yx, H.yy);
      const Matrix H_then = product(then.moment, symmetric_of(row, a.shape));

      const V of_now  = stored_energies<linear_law>(c, H).releasable();
      const V of_then = stored_energies<linear_law>(c, H_then).releasable();
      return {of_now,
              0.5 * (of_now + of_then +
                     0.25 * c.uniform_hourglass *
                         (now.residual(H, C) + then.residual(H_then, C)))};
    }


    /// Materials::softened_stress(), which is linear in the damage.
    struct SofteningStress
    {
      Stress whole, left;

      MORSEL_INLINE
      SofteningStress(const BondedConstants &c, const Stress &s)
      {
        const V mean    = (s.xx + s.yy + s.zz) * (1. / 3.);
        const V pressed = smaller(mean, V{});
        whole           = {s.xx, s.yy, s.xy, c.poissons_ratio * (s.xx + s.yy)};
        left = {pressed, pressed, V{}, c.poissons_ratio * (2. * pressed)};
      }

      MORSEL_INLINE Stress
      at(const V D) const
      {
        const V keep = 1. - D;
        return {D * left.xx + keep * whole.xx,
                D * left.yy + keep * whole.yy,
                keep * whole.xy,
                D * left.zz + keep * whole.zz};
      }
    };


    /// Energy per volume of the elastic solid under a stress [J/m^3].
    MORSEL_INLINE V
    energy_density(const BondedConstants &c, const Stress &s)
    {
      const V trace = s.xx + s.yy + s.zz;
      const V squares =
          s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2. * (s.xy * s.xy);
      return ((1. + c.poissons_ratio) * squares -
              c.poissons_ratio * (trace * trace)) *
             (0.5 / c.youngs_modulus);
    }


    /// Materials::energy_softening() of the particles of a group that take part
    /// and whose strength is exceeded.
    /// @return whether any softens
    template <DriverKind kind, bool linear_law>
    bool
    soften_group(const BondedArrays    &a,
                 const BondedConstants &c,
                 const unsigned int     g,
                 const AveragedStress  &average,
                 GroupSoftening        &state)
    {
      bool any_softens = false;
      for (unsigned int offset = 0; offset < group_size; offset += lanes)
        {
          const Row row(a, g * group_size + offset);
          const V   r    = load(state.threshold + offset),
                  range  = load(state.range + offset);
          const V used   = load(state.used + offset);
          const V before = gather(
              [&](unsigned int l) { return &a.damage[row.particle(l)]; });
          const SofteningStress stress(c,
                                       {load(average.xx + offset),
                                        load(average.yy + offset),
                                        load(average.xy + offset),
                                        load(average.zz + offset)});
          const V               cut_off   = tensile_cut_off(a, row);
          const auto            driver_at = [&](const V D) {
            return driver<kind>(c, stress.at(D), cut_off);
          };
          const V    s       = driver_at(before);
          V          value   = s - r * (1. - used);
          const auto softens = (range > 0.) & (value > 0.);
          store(state.damage + offset, before);
          if (!any(softens))
            continue;
          any_softens = true;

          const Releasable energy =
              releasable_energy<linear_law>(a, c, state, row, g, offset);
          V volume = all(1. / c.density);
          volume *=
              gather([&](unsigned int l) { return &a.mass[row.particle(l)]; });
          V modulus = all(1.);
          if (a.modulus)
            modulus = gather(
                [&](unsigned int l) { return &a.modulus[row.particle(l)]; });
          // Once for the energy, once for that of the softened stress.
          const V per_damage =
              modulus * modulus * energy.now * s * s /
              (range * r * r * energy_density(c, stress.at(before)));
          const auto excess = [&](const V D) {
            return driver_at(D) - r * (1. - used - per_damage * (D - before));
          };

          V    D     = before;
          auto going = softens;
          auto fails = softens & ~softens; // none yet
          for (unsigned int iteration = 0; iteration < 30; ++iteration)
            {
              constexpr double step = 1e-7;
              going                 = going & (value > 1e-10 * s);
              if (!any(going))
                break;
              const V    slope   = (excess(D + step) - value) * (1. / step);
              const V    next    = D - value / slope;
              const auto too_far = going & ~((slope < 0.) & (next < 1.));
              fails              = fails | too_far;
              going              = going & ~too_far;
              D                  = going ? next : D;
              value              = excess(D);
            }
          fails = fails | going;
          store(state.damage + offset,
                fails ? all(1.) : (softens ? D : before));
          store(state.used + offset,
                fails     ? all(1.)
                : softens ? used + per_damage * (D - before)
                          : used);
          store(state.released + offset, modulus * volume * energy.mean);
        }
      return any_softens;
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
