// What the memory gives: a triad a = b + s c over arrays far beyond the caches,
// on one thread and two. doc/performance.md compares the pair loops with it.

#include <benchmark/benchmark.h>

#include <vector>

namespace
{
  /// Each thread has arrays of its own.
  void
  memory_triad(benchmark::State &state)
  {
    const std::size_t   n = state.range(0);
    std::vector<double> a(n, 0.), b(n, 1.), c(n, 2.);
    for (auto _ : state)
      {
        for (std::size_t i = 0; i < n; ++i)
          a[i] = b[i] + 3. * c[i];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
      }
    // Two are read, one is read before it is written, one is written.
    state.SetBytesProcessed(state.iterations() * n * 4 * sizeof(double));
  }
} // namespace


BENCHMARK(memory_triad)->Arg(1 << 24)->Threads(1)->Threads(2)->UseRealTime();
