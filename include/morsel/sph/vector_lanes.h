#ifndef morsel_sph_vector_lanes_h
#define morsel_sph_vector_lanes_h

// Vectors of doubles with whole-record loads and stores, for the kernels that
// are compiled once per instruction set; MORSEL_INSTRUCTION_SET names it and
// MORSEL_LANES is the width. Nothing here is shared between instruction sets.

#include <morsel/core/records.h>

#if defined(__SSE2__)
#  include <immintrin.h>
#endif

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    constexpr unsigned int lanes = MORSEL_LANES;

    using Pair = double __attribute__((vector_size(16)));
    using V    = double __attribute__((vector_size(8 * MORSEL_LANES)));

#define MORSEL_INLINE inline __attribute__((always_inline))

    MORSEL_INLINE V
    load(const double *p)
    {
      V v;
      __builtin_memcpy(&v, p, sizeof(v));
      return v;
    }


    MORSEL_INLINE void
    store(double *p, const V v)
    {
      __builtin_memcpy(p, &v, sizeof(v));
    }


    MORSEL_INLINE Pair
    load_pair(const double *p)
    {
      Pair v;
      __builtin_memcpy(&v, p, sizeof(v));
      return v;
    }


    MORSEL_INLINE V
    all(const double x)
    {
      return x - V{};
    }


    MORSEL_INLINE V
    square_root(const V x)
    {
#if MORSEL_LANES == 8 && defined(__AVX512F__)
      return _mm512_maskz_sqrt_pd(0xff, x);
#elif MORSEL_LANES == 4 && defined(__AVX__)
      return _mm256_sqrt_pd(x);
#elif MORSEL_LANES == 2 && defined(__SSE2__)
      return _mm_sqrt_pd(x);
#else
      V r;
      for (unsigned int l = 0; l < lanes; ++l)
        r[l] = __builtin_sqrt(x[l]);
      return r;
#endif
    }


    MORSEL_INLINE V
    smaller(const V a, const V b)
    {
      return a < b ? a : b;
    }


    MORSEL_INLINE V
    larger(const V a, const V b)
    {
      return a > b ? a : b;
    }


    MORSEL_INLINE double
    sum(const V v)
    {
      double s = v[0];
      for (unsigned int l = 1; l < lanes; ++l)
        s += v[l];
      return s;
    }


    template <typename Mask>
    MORSEL_INLINE bool
    any(const Mask mask)
    {
      bool result = false;
      for (unsigned int l = 0; l < lanes; ++l)
        result = result || mask[l] != 0;
      return result;
    }


    /// Transposes one pair of doubles per lane: pair(l) points at lane l's.
    template <typename Address>
    MORSEL_INLINE void
    gather_pairs(const Address &pair, V &a, V &b)
    {
#if MORSEL_LANES == 2
      const Pair p = load_pair(pair(0)), q = load_pair(pair(1));
      a = __builtin_shufflevector(p, q, 0, 2);
      b = __builtin_shufflevector(p, q, 1, 3);
#else
      // Halves of 128 bits are joined by loads, pairs by one shuffle each.
      using Four   = double __attribute__((vector_size(32)));
      const auto f = [&](const unsigned int l, Four &a, Four &b) {
        const Four even = __builtin_shufflevector(
            load_pair(pair(l)), load_pair(pair(l + 2)), 0, 1, 2, 3);
        const Four odd = __builtin_shufflevector(
            load_pair(pair(l + 1)), load_pair(pair(l + 3)), 0, 1, 2, 3);
        a = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
        b = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
      };
#  if MORSEL_LANES == 4
      f(0, a, b);
#  else
      Four a0, b0, a1, b1;
      f(0, a0, b0);
      f(4, a1, b1);
      a = __builtin_shufflevector(a0, a1, 0, 1, 2, 3, 4, 5, 6, 7);
      b = __builtin_shufflevector(b0, b1, 0, 1, 2, 3, 4, 5, 6, 7);
#  endif
#endif
    }


    /// Four doubles per lane: record(l) points at lane l's.
    template <typename Address>
    MORSEL_INLINE void
    gather_records(const Address &record, V &a, V &b, V &c, V &d)
    {
      gather_pairs(record, a, b);
      gather_pairs([&](const unsigned int l) { return record(l) + 2; }, c, d);
    }


    /// One double per lane.
    template <typename Address>
    MORSEL_INLINE V
    gather(const Address &address)
    {
#if MORSEL_LANES == 2
      return V{*address(0), *address(1)};
#elif MORSEL_LANES == 4
      return V{*address(0), *address(1), *address(2), *address(3)};
#else
      return V{*address(0),
               *address(1),
               *address(2),
               *address(3),
               *address(4),
               *address(5),
               *address(6),
               *address(7)};
#endif
    }


    /// The reverse of gather_pairs() for the first @p n lanes.
    template <typename Address>
    MORSEL_INLINE void
    scatter_pairs(const Address     &pair,
                  const unsigned int n,
                  const V            a,
                  const V            b)
    {
      for (unsigned int l = 0; l < lanes; ++l)
        if (l < n)
          {
            const Pair p = {a[l], b[l]};
            __builtin_memcpy(pair(l), &p, sizeof(p));
          }
    }


    template <typename Address>
    MORSEL_INLINE void
    scatter_records(const Address     &record,
                    const unsigned int n,
                    const V            a,
                    const V            b,
                    const V            c,
                    const V            d)
    {
      scatter_pairs(record, n, a, b);
      scatter_pairs(
          [&](const unsigned int l) { return record(l) + 2; }, n, c, d);
    }


    /// Addresses of the records of @p index, for gather() and its like.
    template <typename Record>
    MORSEL_INLINE auto
    neighbours_in(const Record *records, const unsigned int *index)
    {
      return [records, index](const unsigned int l) {
        return (const double *)(records + index[l]);
      };
    }


    /// J^(-2/3) to round-off.
    MORSEL_INLINE V
    power_minus_two_thirds(const V J)
    {
      const V e = J - 1.;
      if (!any(e * e > 0.0625 || e != e))
        {
          // Taylor, then twice y (1 - rho)^(-1/3) with rho = 1 - J^2 y^3.
          V y = 1. + e * (-2. / 3. + e * (5. / 9. - 40. / 81. * e));
          for (unsigned int k = 0; k < 2; ++k)
            {
              const V rho = 1. - (J * J) * (y * y * y);
              y += y * rho * (1. / 3. + rho * (2. / 9. + 14. / 81. * rho));
            }
          return y;
        }
      V y;
      for (unsigned int l = 0; l < lanes; ++l)
        {
          const double root = __builtin_cbrt(J[l]);
          y[l]              = 1. / (root * root);
        }
      return y;
    }
  } // namespace
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
