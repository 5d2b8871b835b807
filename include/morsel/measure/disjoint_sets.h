#ifndef morsel_measure_disjoint_sets_h
#define morsel_measure_disjoint_sets_h

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace Morsel::Measure
{
  /// Disjoint sets of particles; the root of a set is its first particle,
  /// which makes the numbering independent of the order of the bonds.
  class DisjointSets
  {
  public:
    explicit DisjointSets(const std::size_t n)
        : parent(n)
    {
      std::iota(parent.begin(), parent.end(), 0u);
    }

    std::uint32_t
    root(std::uint32_t i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }

    void
    join(const std::uint32_t i, const std::uint32_t j)
    {
      const std::uint32_t a = root(i), b = root(j);
      parent[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent;
  };
} // namespace Morsel::Measure

#endif
