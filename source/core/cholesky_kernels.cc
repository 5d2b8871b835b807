#include <morsel/core/cholesky_kernels.h>

namespace Morsel
{
  // One namespace per instruction set, see source/CMakeLists.txt.
  namespace baseline
  {
    const CholeskyKernels &
    cholesky_kernels();
  }
#ifdef MORSEL_X86_64_KERNELS
  namespace avx2
  {
    const CholeskyKernels &
    cholesky_kernels();
  }
  namespace avx512
  {
    const CholeskyKernels &
    cholesky_kernels();
  }
#endif


  const CholeskyKernels &
  cholesky_kernels()
  {
#ifdef MORSEL_X86_64_KERNELS
    if (__builtin_cpu_supports("x86-64-v4"))
      return avx512::cholesky_kernels();
    if (__builtin_cpu_supports("x86-64-v3"))
      return avx2::cholesky_kernels();
#endif
    return baseline::cholesky_kernels();
  }
} // namespace Morsel
