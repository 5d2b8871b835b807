#ifndef morsel_sph_driver_kernels_h
#define morsel_sph_driver_kernels_h

// The drivers of damage, for the groups of bonded_kernels.h. Compiled once per
// instruction set.

#include <morsel/sph/bonded_kernels.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    /// Order of Materials::Driver.
    enum DriverKind
    {
      tensile_stress,
      extension_strain,
      modified_von_mises
    };


    MORSEL_INLINE V
    largest_principal(const Stress &s)
    {
      const V half = 0.5 * (s.xx - s.yy);
      return 0.5 * (s.xx + s.yy) + square_root(half * half + s.xy * s.xy);
    }


    /// Materials::driver_value() and, where @p cut_off is not zero, the
    /// tensile cut-off.
    template <DriverKind kind>
    MORSEL_INLINE V
    driver(const BondedConstants &c, const Stress &s, const V cut_off)
    {
      const V sigma_1 = largest_principal(s);
      if constexpr (kind == tensile_stress)
        return larger(V{}, larger(sigma_1, s.zz)) / c.tensile_strength;
      else if constexpr (kind == extension_strain)
        {
          const V sigma_2 = s.xx + s.yy - sigma_1;
          const V strain  = (sigma_1 - c.poissons_ratio * (sigma_2 + s.zz)) /
                           c.youngs_modulus;
          return larger(V{}, strain) * c.extension_scale;
        }
      else
        {
          const V I1 = s.xx + s.yy + s.zz, mean = I1 * (1. / 3.);
          const V dx = s.xx - mean, dy = s.yy - mean, dz = s.zz - mean;
          const V J2  = 0.5 * (dx * dx + dy * dy + dz * dz) + s.xy * s.xy;
          const V dI1 = c.von_mises_d * I1;
          const V value =
              (dI1 + square_root(dI1 * dI1 + 12. * c.von_mises_P * J2)) *
              (1. / (2. * c.von_mises_P));
          const V cut = larger(sigma_1, s.zz) * (1. / c.tensile_strength);
          return cut_off != 0. ? larger(value, cut) : value;
        }
    }


    /// Zero for particles without the tensile cut-off.
    MORSEL_INLINE V
    tensile_cut_off(const BondedArrays &a, const Row &row)
    {
      V cut_off;
      for (unsigned int l = 0; l < lanes; ++l)
        cut_off[l] = a.near_face[row.particle(l)] ? 0. : 1.;
      return cut_off;
    }


    template <DriverKind kind>
    void
    own_driver(const BondedArrays    &a,
               const BondedConstants &c,
               const unsigned int     begin,
               const unsigned int     end)
    {
      for (unsigned int g = begin; g < end; ++g)
        {
          double strongest = 0.;
          if (a.slot_begin[g] != a.slot_end[g])
            for (unsigned int offset = 0; offset < group_size; offset += lanes)
              {
                const Row row(a, g * group_size + offset);
                Stress    s;
                gather_records(row.of(a.effective), s.xx, s.yy, s.xy, s.zz);
                const V value = driver<kind>(c, s, all(1.));
                for (unsigned int l = 0; l < lanes; ++l)
                  {
                    if (l < row.n)
                      a.driver[row.first + l] = value[l];
                    strongest = strongest < value[l] ? value[l] : strongest;
                  }
              }
          a.strongest[g] = strongest;
        }
    }


    /// Shepard average (T3-35) of the undamaged stress over the particle and
    /// its live neighbours; volumes are equal.
    template <DriverKind kind>
    void
    average_driver(const BondedArrays    &a,
                   const BondedConstants &c,
                   const unsigned int     g,
                   AveragedStress        &average)
    {
      for (unsigned int offset = 0; offset < group_size; offset += lanes)
        {
          const Row row(a, g * group_size + offset);
          Stress    s;
          gather_records(row.of(a.effective), s.xx, s.yy, s.xy, s.zz);
          V total = all(c.average_self);
          s       = {total * s.xx, total * s.yy, total * s.xy, total * s.zz};
          for (unsigned int slot = a.slot_begin[g]; slot < a.near_end[g];
               ++slot)
            {
              const unsigned int k = slot * group_size + offset;
              const V            w = load(a.average + k);
              V                  xx, yy, xy, zz;
              gather_records(
                  neighbours_in(a.effective, a.index + k), xx, yy, xy, zz);
              s.xx += w * xx;
              s.yy += w * yy;
              s.xy += w * xy;
              s.zz += w * zz;
              total += w;
            }
          const V inverse = 1. / total;
          s = {inverse * s.xx, inverse * s.yy, inverse * s.xy, inverse * s.zz};
          store(average.xx + offset, s.xx);
          store(average.yy + offset, s.yy);
          store(average.xy + offset, s.xy);
          store(average.zz + offset, s.zz);
          store(average.driver + offset,
                driver<kind>(c, s, tensile_cut_off(a, row)));
        }
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
