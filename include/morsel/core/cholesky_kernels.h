#ifndef morsel_core_cholesky_kernels_h
#define morsel_core_cholesky_kernels_h

namespace Morsel
{
  /// Dense elimination for one instruction set. Plain addresses only, as in
  /// PairKernels: no inline function of a class is compiled twice.
  struct CholeskyKernels
  {
    /// Eliminates the first @p p columns of a symmetric matrix of @p m rows,
    /// of which the lower triangle is kept by columns: their part becomes that
    /// of the Cholesky factor, the rest the Schur complement.
    /// @param size what a pivot is compared with, of the first p rows
    /// @param work of workspace(m) doubles
    /// @return whether all pivots were clearly positive
    bool (*eliminate)(double       *a,
                      unsigned int  m,
                      unsigned int  p,
                      const double *size,
                      double       *work);

    unsigned int (*workspace)(unsigned int m);

    /// Solves with the m x p part of the factor, from the left: x of p entries
    /// becomes L^-1 x, rest of m - p entries what is left of it.
    void (*forward)(const double *factor,
                    unsigned int  m,
                    unsigned int  p,
                    double       *x,
                    double       *rest);

    /// Its transpose: x becomes L^-T (x - L_rest^T rest).
    void (*backward)(const double *factor,
                     unsigned int  m,
                     unsigned int  p,
                     double       *x,
                     const double *rest);
  };

  /// Those of the machine that runs.
  const CholeskyKernels &
  cholesky_kernels();
} // namespace Morsel

#endif
