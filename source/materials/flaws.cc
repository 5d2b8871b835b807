#include <morsel/materials/flaws.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Materials
{
  double
  counter_uniform(const unsigned int seed, const std::uint64_t index)
  {
    std::uint64_t z =
        index + 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(seed) + 1);
    for (int round = 0; round < 2; ++round)
      {
        z += 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
      }
    return (static_cast<double>(z >> 11) + 0.5) / 9007199254740992.;
  }


  double
  counter_normal(const unsigned int seed, const std::uint64_t index)
  {
    // By Box and Muller; streams of their own, apart from that of single
    // particles.
    const double a = counter_uniform(seed ^ 0x5bd1e995U, index);
    const double b = counter_uniform(seed ^ 0x1b873593U, index);
    return std::sqrt(-2. * std::log(a)) *
           std::cos(2. * dealii::numbers::PI * b);
  }


  std::uint64_t
  square_number(const long i, const long j)
  {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32) |
           static_cast<std::uint32_t>(j);
  }


  double
  weibull_threshold(const double             m,
                    const unsigned int       seed,
                    const unsigned long long index)
  {
    return std::pow(-std::log(counter_uniform(seed, index)), 1. / m);
  }


  CorrelatedField::CorrelatedField(const double length, const unsigned int seed)
      : length(length)
      , side(0.5 * length)
      , seed(seed)
  {}


  double
  CorrelatedField::operator()(const dealii::Point<2> &x) const
  {
    constexpr long reach = 6; // squares: three lengths
    const long     i0 = std::lround(x[0] / side), j0 = std::lround(x[1] / side);
    double         sum = 0., square = 0.;
    for (long i = i0 - reach; i <= i0 + reach; ++i)
      for (long j = j0 - reach; j <= j0 + reach; ++j)
        {
          const double w = std::exp(
              -(dealii::Point<2>(i * side, j * side) - x).norm_square() /
              (length * length));
          sum += w * counter_normal(seed, square_number(i, j));
          square += w * w;
        }
    return sum / std::sqrt(square);
  }


  double
  weibull_of_normal(const double m, const double normal)
  {
    // 1 - F of either distribution.
    return std::pow(-std::log(0.5 * std::erfc(normal / std::sqrt(2.))), 1. / m);
  }


  unsigned int
  ExplicitFlaws::activated(const unsigned int i, const double s) const
  {
    const auto begin = threshold.begin() + first[i];
    return std::lower_bound(begin, threshold.begin() + first[i + 1], s) - begin;
  }


  ExplicitFlaws
  explicit_flaws(const double m, const unsigned int seed, const unsigned int n)
  {
    std::vector<unsigned int> owner;
    std::vector<unsigned int> count(n, 0);
    for (unsigned int without = n; without > 0;)
      {
        const double u = counter_uniform(seed, owner.size());
        owner.push_back(std::min(n - 1, static_cast<unsigned int>(u * n)));
        if (count[owner.back()]++ == 0)
          --without;
      }
    ExplicitFlaws flaws;
    flaws.first.assign(n + 1, 0);
    for (unsigned int i = 0; i < n; ++i)
      flaws.first[i + 1] = flaws.first[i] + count[i];
    flaws.threshold.resize(owner.size());
    std::vector<unsigned int> next(flaws.first.begin(), flaws.first.end() - 1);
    for (std::size_t j = 0; j < owner.size(); ++j)
      flaws.threshold[next[owner[j]]++] = std::pow((j + 1.) / n, 1. / m);
    return flaws;
  }
} // namespace Morsel::Materials
