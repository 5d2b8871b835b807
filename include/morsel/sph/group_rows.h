#ifndef morsel_sph_group_rows_h
#define morsel_sph_group_rows_h

// What the kernels of bonded particles work on: particles of a group side by
// side, and matrices of them. Compiled once per instruction set.

#include <morsel/sph/pair_kernels.h>
#include <morsel/sph/vector_lanes.h>

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    struct Matrix
    {
      V xx{}, xy{}, yx{}, yy{};

      /// Adds u (x) g.
      MORSEL_INLINE void
      add(const V u_x, const V u_y, const V g_x, const V g_y)
      {
        xx += u_x * g_x;
        xy += u_x * g_y;
        yx += u_y * g_x;
        yy += u_y * g_y;
      }
    };


    /// A B.
    MORSEL_INLINE Matrix
    product(const Matrix &A, const Matrix &B)
    {
      return {A.xx * B.xx + A.xy * B.yx,
              A.xx * B.xy + A.xy * B.yy,
              A.yx * B.xx + A.yy * B.yx,
              A.yx * B.xy + A.yy * B.yy};
    }


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


    MORSEL_INLINE Matrix
    symmetric_of(const Row &row, const Symmetric2 *matrices)
    {
      const V xx =
          gather([&](unsigned int l) { return &matrices[row.particle(l)].xx; });
      const V yy =
          gather([&](unsigned int l) { return &matrices[row.particle(l)].yy; });
      const V xy =
          gather([&](unsigned int l) { return &matrices[row.particle(l)].xy; });
      return {xx, xy, xy, yy};
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
