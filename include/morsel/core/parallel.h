#ifndef morsel_core_parallel_h
#define morsel_core_parallel_h

#include <deal.II/base/parallel.h>

namespace Morsel
{
  /// Runs f(begin, end) over subranges of [0, n) on the threads that deal.II
  /// was given. Every element is worked on by one thread alone and must not
  /// touch another's results: the outcome does not depend on the number of
  /// threads.
  template <typename Function>
  void
  parallel_for(const unsigned int n, const Function &f)
  {
    constexpr unsigned int grain = 512;
    dealii::parallel::apply_to_subranges(0u, n, f, grain);
  }
} // namespace Morsel

#endif
