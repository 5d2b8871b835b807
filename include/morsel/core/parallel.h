#ifndef morsel_core_parallel_h
#define morsel_core_parallel_h

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <numeric>
#include <vector>

#if defined(__SANITIZE_THREAD__)
extern "C" void
__tsan_acquire(void *address);
extern "C" void
__tsan_release(void *address);
#endif

namespace Morsel
{
  /// TBB is not instrumented: ThreadSanitizer has to be told what passes from
  /// the thread that starts tasks to them, and back.
  class HandOver
  {
  public:
    void
    give()
    {
#if defined(__SANITIZE_THREAD__)
      __tsan_release(this);
#endif
    }

    void
    take()
    {
#if defined(__SANITIZE_THREAD__)
      __tsan_acquire(this);
#endif
    }
  };


  /// Runs f(begin, end) over subranges of [0, n) on the threads that deal.II
  /// was given. Every element is worked on by one thread alone and must not
  /// touch another's results: the outcome does not depend on the number of
  /// threads.
  /// @param grain elements that are worth a task of their own.
  template <typename Function>
  void
  parallel_for(const unsigned int n,
               const Function    &f,
               const unsigned int grain = 512)
  {
    HandOver to_tasks, from_tasks;
    to_tasks.give();
    dealii::parallel::apply_to_subranges(
        0u,
        n,
        [&](const unsigned int begin, const unsigned int end) {
          to_tasks.take();
          f(begin, end);
          from_tasks.give();
        },
        grain);
    from_tasks.take();
  }


  /// Sum of term(i) over [0, n), of blocks whose size does not depend on the
  /// number of threads: neither does the result.
  template <typename Term>
  double
  parallel_sum(const unsigned int n, const Term &term)
  {
    constexpr unsigned int block = 512;
    std::vector<double>    sums((n + block - 1) / block, 0.);
    parallel_for(
        sums.size(),
        [&](const unsigned int begin, const unsigned int end) {
          for (unsigned int b = begin; b < end; ++b)
            for (unsigned int i = b * block; i < std::min(n, (b + 1) * block);
                 ++i)
              sums[b] += term(i);
        },
        4);
    return std::accumulate(sums.begin(), sums.end(), 0.);
  }
} // namespace Morsel

#endif
