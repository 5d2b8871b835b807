#include <morsel/sph/pair_kernels.h>


namespace Morsel::SPH
{
  // One namespace per instruction set, see source/CMakeLists.txt.
  namespace baseline
  {
    const PairKernels &
    kernels();
  }
#ifdef MORSEL_X86_64_KERNELS
  namespace avx2
  {
    const PairKernels &
    kernels();
  }
  namespace avx512
  {
    const PairKernels &
    kernels();
  }
#endif


  const PairKernels &
  pair_kernels()
  {
#ifdef MORSEL_X86_64_KERNELS
    if (__builtin_cpu_supports("x86-64-v4"))
      return avx512::kernels();
    if (__builtin_cpu_supports("x86-64-v3"))
      return avx2::kernels();
#endif
    return baseline::kernels();
  }
} // namespace Morsel::SPH
