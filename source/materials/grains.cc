#include <morsel/materials/grains.h>

#include <deal.II/base/patterns.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace Morsel::Materials
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Streams of random numbers, apart from that of the flaws.
    enum Stream : unsigned int
    {
      point_x   = 0x2545f491U,
      point_y   = 0x85ebca6bU,
      modulus_  = 0xc2b2ae35U,
      strength_ = 0x27d4eb2fU
    };


    double
    counter_uniform(const unsigned int seed, const std::uint64_t index)
    {
      std::uint64_t z = index + 0x9e3779b97f4a7c15ULL *
                                    (static_cast<std::uint64_t>(seed) + 1);
      for (int round = 0; round < 2; ++round)
        {
          z += 0x9e3779b97f4a7c15ULL;
          z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
          z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
          z ^= z >> 31;
        }
      return (static_cast<double>(z >> 11) + 0.5) / 9007199254740992.;
    }


    /// The number of a square.
    std::uint64_t
    number_of(const std::pair<long, long> &square)
    {
      return (static_cast<std::uint64_t>(
                  static_cast<std::uint32_t>(square.first))
              << 32) |
             static_cast<std::uint32_t>(square.second);
    }
  } // namespace


  void
  GrainParameters::declare(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    prm.add_parameter("Size",
                      size,
                      "Mean diameter of grains that differ in stiffness and "
                      "strength [m]; 0: a homogeneous solid.",
                      Patterns::Double(0.));
    prm.add_parameter(
        "Modulus scatter",
        modulus_scatter,
        "Coefficient of variation of Young's modulus from grain to grain "
        "(log-normal) [1]; a large body keeps the modulus of its material.",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Strength scatter",
        strength_scatter,
        "Coefficient of variation of the thresholds of damage from grain to "
        "grain (log-normal, mean 1) [1].",
        Patterns::Double(0., 1.));
  }


  double
  homogenisation_exponent(const double nu)
  {
    const double x = 1. / (1. - 2. * nu); // (lambda + mu)/mu
    return x * (x + 4.) / (2. * (x + 1.) * (x + 1.));
  }


  GrainField::GrainField(const GrainParameters &parameters,
                         const double           poissons_ratio,
                         const unsigned int     seed)
      : side(0.5 * std::sqrt(pi) * parameters.size)
      , seed(seed)
      , modulus{(homogenisation_exponent(poissons_ratio) - 0.5) *
                    std::log1p(parameters.modulus_scatter *
                               parameters.modulus_scatter),
                std::sqrt(std::log1p(parameters.modulus_scatter *
                                     parameters.modulus_scatter))}
      , strength{-0.5 * std::log1p(parameters.strength_scatter *
                                   parameters.strength_scatter),
                 std::sqrt(std::log1p(parameters.strength_scatter *
                                      parameters.strength_scatter))}
  {}


  std::pair<long, long>
  GrainField::grain_at(const dealii::Point<2> &x) const
  {
    // The own square's point is at most sqrt(2) sides away, points more than
    // two squares further at least two.
    const std::pair<long, long> own = {
        static_cast<long>(std::floor(x[0] / side)),
        static_cast<long>(std::floor(x[1] / side))};
    std::pair<long, long> nearest = own;
    double                least   = std::numeric_limits<double>::max();
    for (long i = own.first - 2; i <= own.first + 2; ++i)
      for (long j = own.second - 2; j <= own.second + 2; ++j)
        {
          const std::uint64_t    n = number_of({i, j});
          const dealii::Point<2> p(
              side * (i + counter_uniform(seed ^ point_x, n)),
              side * (j + counter_uniform(seed ^ point_y, n)));
          if (const double d = p.distance_square(x); d < least)
            {
              least   = d;
              nearest = {i, j};
            }
        }
    return nearest;
  }


  double
  GrainField::factor(const dealii::Point<2> &x,
                     const LogNormal        &distribution,
                     const unsigned int      stream) const
  {
    // By Box and Muller.
    const std::uint64_t n = number_of(grain_at(x));
    const double        a = counter_uniform(seed ^ stream, n);
    const double        b = counter_uniform(seed ^ ~stream, n);
    return std::exp(distribution.location + distribution.scale *
                                                std::sqrt(-2. * std::log(a)) *
                                                std::cos(2. * pi * b));
  }


  double
  GrainField::modulus_factor(const dealii::Point<2> &x) const
  {
    return factor(x, modulus, Stream::modulus_);
  }


  double
  GrainField::strength_factor(const dealii::Point<2> &x) const
  {
    return factor(x, strength, Stream::strength_);
  }
} // namespace Morsel::Materials
