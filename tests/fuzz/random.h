#ifndef morsel_fuzz_random_h
#define morsel_fuzz_random_h

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace Fuzz
{
  /// The choices that make a mutant: the same seed and number give the same
  /// choices on every machine (std::mt19937_64 is prescribed to the bit; the
  /// standard's distributions are not, and not used).
  class Random
  {
  public:
    Random(const std::uint64_t seed, const std::uint64_t number)
    {
      std::seed_seq sequence{seed, seed >> 32, number, number >> 32};
      engine.seed(sequence);
    }

    /// A whole number from 0 to n-1; n must not be 0.
    std::size_t
    below(const std::size_t n)
    {
      return engine() % n;
    }

    bool
    chance(const unsigned int percent)
    {
      return below(100) < percent;
    }

    template <typename T>
    const T &
    pick(const std::vector<T> &list)
    {
      return list[below(list.size())];
    }

    std::string
    bytes(const std::size_t n)
    {
      std::string text(n, '\0');
      for (char &c : text)
        c = static_cast<char>(below(256));
      return text;
    }

  private:
    std::mt19937_64 engine;
  };
} // namespace Fuzz

#endif
