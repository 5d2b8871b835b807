#ifndef morsel_materials_flaws_h
#define morsel_materials_flaws_h

#include <morsel/materials/damage.h>

#include <deal.II/base/point.h>

#include <cstdint>
#include <vector>

namespace Morsel::Materials
{
  /// Uniform number in (0, 1), a function of its arguments alone: no state, no
  /// order (splitmix64 as a counter-based generator).
  double
  counter_uniform(unsigned int seed, std::uint64_t index);


  /// Weibull(m, 1) threshold of one particle, a function of the seed and of
  /// the particle's global index alone (the same on any number of ranks).
  double
  weibull_threshold(double             weibull_modulus,
                    unsigned int       seed,
                    unsigned long long index);


  /// A Gaussian random field g(x) of mean 0 and variance 1 with correlation
  /// exp(-r^2/(2 l^2)), a function of the place and the seed alone: the same
  /// field whatever particles ask for it.
  ///
  /// White noise on a grid of squares of side l/2, fixed to the origin, is
  /// smoothed with exp(-r^2/l^2) out to 3 l, and the sum divided by the root
  /// of the sum of squared weights.
  class CorrelatedField
  {
  public:
    /// @param length l [m], above 0.
    CorrelatedField(double length, unsigned int seed);

    double
    operator()(const dealii::Point<2> &x) const;

  private:
    const double       length, side;
    const unsigned int seed;
  };


  /// Weibull(m, 1) threshold of a standard normal number: equal shares of
  /// both distributions lie below.
  double
  weibull_of_normal(double weibull_modulus, double normal);


  /// Flaws of each particle as Benz and Asphaug (1995) hand them out: flaw
  /// number j = 1, 2, ... of threshold (j/n)^(1/m) goes to a particle drawn
  /// at random, until every one of the n particles has one.
  struct ExplicitFlaws
  {
    std::vector<unsigned int> first;     ///< n + 1 places in threshold
    std::vector<double>       threshold; ///< rising within a particle [1]

    /// Flaws of particle @p i with a threshold below @p s.
    unsigned int
    activated(unsigned int i, double s) const;

    unsigned int
    count(const unsigned int i) const
    {
      return first[i + 1] - first[i];
    }
  };


  /// @param n particles of the whole body, numbered from 0.
  ExplicitFlaws
  explicit_flaws(double weibull_modulus, unsigned int seed, unsigned int n);


  /// Thresholds r_i [1] of particles, in the order of @p ids: r0 of the law
  /// times 1, Weibull's w of the particle's number, of the field at its
  /// place, or its weakest explicit flaw, as DamageParameters::flaws says.
  /// @param ids global numbers, from 0
  /// @param points places in the undeformed body [m]
  /// @param n_global particles of the whole body
  template <typename Id>
  std::vector<double>
  thresholds(const DamageParameters              &parameters,
             const DamageLaw                     &law,
             const unsigned int                   seed,
             const std::vector<Id>               &ids,
             const std::vector<dealii::Point<2>> &points,
             const unsigned int                   n_global)
  {
    const double        m = law.weibull_modulus;
    std::vector<double> r(ids.size(), law.threshold_scale);
    if (parameters.flaws == "Weibull")
      for (std::size_t i = 0; i < ids.size(); ++i)
        r[i] *= weibull_threshold(m, seed, ids[i]);
    else if (parameters.flaws == "correlated")
      {
        const CorrelatedField field(parameters.correlation_length, seed);
        for (std::size_t i = 0; i < ids.size(); ++i)
          r[i] *= weibull_of_normal(m, field(points[i]));
      }
    else if (parameters.flaws == "Benz-Asphaug")
      {
        const ExplicitFlaws flaws = explicit_flaws(m, seed, n_global);
        for (std::size_t i = 0; i < ids.size(); ++i)
          r[i] *= flaws.threshold[flaws.first[ids[i]]];
      }
    return r;
  }
} // namespace Morsel::Materials

#endif
