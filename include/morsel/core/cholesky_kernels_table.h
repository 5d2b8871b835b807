#ifndef morsel_core_cholesky_kernels_table_h
#define morsel_core_cholesky_kernels_table_h

// The kernels of one instruction set, see source/CMakeLists.txt.

#include <morsel/core/cholesky_kernels.h>

namespace Morsel::MORSEL_INSTRUCTION_SET
{
  namespace
  {
    using Size = unsigned long;

    constexpr unsigned int lanes = MORSEL_LANES;
    /// A vector that may lie anywhere.
    typedef double Lanes
        __attribute__((vector_size(8 * MORSEL_LANES), aligned(8), may_alias));

    /// A tile's sums fill the registers, but for what feeds them.
    constexpr unsigned int tile_vectors = 3;
    constexpr unsigned int tile_rows    = tile_vectors * lanes;
    constexpr unsigned int tile_columns = lanes == 8 ? 8 : 4;
    /// Columns eliminated at a time: their tiles stay in the cache.
    constexpr unsigned int depth = 256;
    /// Fewer columns than this are eliminated one by one.
    constexpr unsigned int narrow = 8;
    /// A smaller share of its row's size makes no pivot.
    constexpr double smallest_pivot = 1e-13;


    unsigned int
    up_to_multiple(const unsigned int n, const unsigned int of)
    {
      return (n + of - 1) / of * of;
    }


    unsigned int
    lesser(const unsigned int a, const unsigned int b)
    {
      return a < b ? a : b;
    }


    /// Copies rows [begin, end) of columns [k, k + n) so that the entries of a
    /// column of a tile follow each other.
    void
    pack(const double      *a,
         const unsigned int ld,
         const unsigned int begin,
         const unsigned int end,
         const unsigned int width,
         const unsigned int k,
         const unsigned int n,
         double            *packed)
    {
      for (unsigned int first = begin; first < end; first += width)
        for (unsigned int l = 0; l < n; ++l, packed += width)
          {
            const unsigned int count = lesser(width, end - first);
            const double      *from  = a + Size(k + l) * ld + first;
            for (unsigned int r = 0; r < count; ++r)
              packed[r] = from[r];
            for (unsigned int r = count; r < width; ++r)
              packed[r] = 0.;
          }
    }


    /// c -= rows columns^T for one tile of c.
    void
    subtract_tile(const double      *rows,
                  const double      *columns,
                  const unsigned int n,
                  double            *c,
                  const unsigned int ld)
    {
      Lanes sum[tile_columns][tile_vectors] = {};
      for (unsigned int l = 0; l < n;
           ++l, rows += tile_rows, columns += tile_columns)
        {
          Lanes a[tile_vectors];
#pragma GCC unroll 8
          for (unsigned int v = 0; v < tile_vectors; ++v)
            a[v] = *reinterpret_cast<const Lanes *>(rows + v * lanes);
#pragma GCC unroll 8
          for (unsigned int j = 0; j < tile_columns; ++j)
#pragma GCC unroll 8
            for (unsigned int v = 0; v < tile_vectors; ++v)
              sum[j][v] += a[v] * columns[j];
        }
#pragma GCC unroll 8
      for (unsigned int j = 0; j < tile_columns; ++j)
#pragma GCC unroll 8
        for (unsigned int v = 0; v < tile_vectors; ++v)
          *reinterpret_cast<Lanes *>(c + Size(j) * ld + v * lanes) -= sum[j][v];
    }


    /// Subtracts from the columns [begin, end), rows [begin, m), what the
    /// columns [k, k_end) of the factor make of them.
    void
    update(double            *a,
           const unsigned int m,
           const unsigned int begin,
           const unsigned int end,
           unsigned int       k,
           const unsigned int k_end,
           double            *work)
    {
      double *rows = work, *columns = work + tile_rows * depth;
      for (; k < k_end; k += depth)
        {
          const unsigned int n = lesser(depth, k_end - k);
          pack(a, m, begin, end, tile_columns, k, n, columns);
          for (unsigned int row = begin; row < m; row += tile_rows)
            {
              pack(
                  a, m, row, lesser(row + tile_rows, m), tile_rows, k, n, rows);
              const unsigned int last = lesser(end, row + tile_rows);
              for (unsigned int j = begin; j < last; j += tile_columns)
                {
                  const double *right = columns + Size(j - begin) * n;
                  double       *c     = a + Size(j) * m + row;
                  if (row + tile_rows <= m && j + tile_columns <= end)
                    {
                      subtract_tile(rows, right, n, c, m);
                      continue;
                    }
                  double tile[tile_rows * tile_columns] = {};
                  subtract_tile(rows, right, n, tile, tile_rows);
                  for (unsigned int q = 0; q < lesser(tile_columns, end - j);
                       ++q)
                    for (unsigned int r = 0; r < lesser(tile_rows, m - row);
                         ++r)
                      c[Size(q) * m + r] += tile[q * tile_rows + r];
                }
            }
        }
    }


    /// Eliminates the columns [begin, end) on themselves, over all rows below.
    bool
    factorise(double            *a,
              const unsigned int m,
              const unsigned int begin,
              const unsigned int end,
              const double      *size,
              double            *work)
    {
      if (end - begin > narrow)
        {
          const unsigned int middle =
              begin + up_to_multiple((end - begin) / 2, narrow);
          if (!factorise(a, m, begin, middle, size, work))
            return false;
          update(a, m, middle, end, begin, middle, work);
          return factorise(a, m, middle, end, size, work);
        }
      for (unsigned int j = begin; j < end; ++j)
        {
          double *column = a + Size(j) * m;
          for (unsigned int k = begin; k < j; ++k)
            {
              const double *left   = a + Size(k) * m;
              const double  factor = left[j];
              for (unsigned int i = j; i < m; ++i)
                column[i] -= factor * left[i];
            }
          if (!(column[j] > smallest_pivot * size[j]))
            return false;
          const double scale = 1. / __builtin_sqrt(column[j]);
          for (unsigned int i = j; i < m; ++i)
            column[i] *= scale;
        }
      return true;
    }


    bool
    eliminate(double            *a,
              const unsigned int m,
              const unsigned int p,
              const double      *size,
              double            *work)
    {
      if (!factorise(a, m, 0, p, size, work))
        return false;
      update(a, m, p, m, 0, p, work);
      return true;
    }


    unsigned int
    workspace(const unsigned int m)
    {
      return (tile_rows + up_to_multiple(m, tile_columns)) * depth;
    }


    void
    forward(const double      *factor,
            const unsigned int m,
            const unsigned int p,
            double            *x,
            double            *rest)
    {
      for (unsigned int j = 0; j < p; ++j, factor += m)
        {
          const double value = x[j] /= factor[j];
          for (unsigned int i = j + 1; i < p; ++i)
            x[i] -= value * factor[i];
          for (unsigned int i = p; i < m; ++i)
            rest[i - p] -= value * factor[i];
        }
    }


    void
    backward(const double      *factor,
             const unsigned int m,
             const unsigned int p,
             double            *x,
             const double      *rest)
    {
      for (unsigned int j = p; j-- > 0;)
        {
          const double *column = factor + Size(j) * m;
          const double *below  = column + p;
          // In vectors: the compiler may not change the order of a sum.
          Lanes        sums = {};
          unsigned int i    = 0;
          for (; i + lanes <= m - p; i += lanes)
            sums += *reinterpret_cast<const Lanes *>(below + i) *
                    *reinterpret_cast<const Lanes *>(rest + i);
          double sum = x[j];
          for (; i < m - p; ++i)
            sum -= below[i] * rest[i];
          for (unsigned int l = 0; l < lanes; ++l)
            sum -= sums[l];
          for (i = j + 1; i < p; ++i)
            sum -= column[i] * x[i];
          x[j] = sum / column[j];
        }
    }
  } // namespace


  const CholeskyKernels &
  cholesky_kernels()
  {
    static constexpr CholeskyKernels table = {
        eliminate, workspace, forward, backward};
    return table;
  }
} // namespace Morsel::MORSEL_INSTRUCTION_SET

#endif
