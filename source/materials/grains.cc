#include <morsel/materials/flaws.h>
#include <morsel/materials/grains.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace Morsel::Materials
{
  namespace
  {
    /// Streams of random numbers, apart from that of the flaws.
    enum Stream : unsigned int
    {
      point_x     = 0x2545f491U,
      point_y     = 0x85ebca6bU,
      of_modulus  = 0xc2b2ae35U,
      of_strength = 0x27d4eb2fU
    };

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
      : side(0.5 * std::sqrt(dealii::numbers::PI) * parameters.size)
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
          const std::uint64_t    n = square_number(i, j);
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
    const auto [i, j] = grain_at(x);
    return std::exp(distribution.location +
                    distribution.scale *
                        counter_normal(seed ^ stream, square_number(i, j)));
  }


  double
  GrainField::modulus_factor(const dealii::Point<2> &x) const
  {
    return factor(x, modulus, of_modulus);
  }


  double
  GrainField::strength_factor(const dealii::Point<2> &x) const
  {
    return factor(x, strength, of_strength);
  }
} // namespace Morsel::Materials
