#include <morsel/study/regression.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <numeric>

namespace Morsel::Study
{
  namespace
  {
    double
    mean(const std::vector<double> &sample)
    {
      return std::accumulate(sample.begin(), sample.end(), 0.) /
             static_cast<double>(sample.size());
    }


    /// Sum of (a - mean a) (b - mean b).
    double
    co_moment(const std::vector<double> &a, const std::vector<double> &b)
    {
      const double mean_a = mean(a), mean_b = mean(b);
      double       sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - mean_a) * (b[i] - mean_b);
      return sum;
    }


    /// Whether the second moment is more than round-off of the mean.
    bool
    varies(const std::vector<double> &sample)
    {
      return sample.size() > 1 &&
             co_moment(sample, sample) > 1e-20 * mean(sample) * mean(sample);
    }


    double
    two_sided_p(const double t, const double degrees_of_freedom)
    {
      const boost::math::students_t distribution(degrees_of_freedom);
      return 2. * boost::math::cdf(
                      boost::math::complement(distribution, std::abs(t)));
    }
  } // namespace


  std::optional<Line>
  fit_line(const std::vector<double> &x, const std::vector<double> &y)
  {
    if (!varies(x))
      return std::nullopt;
    Line line;
    line.n_points  = x.size();
    line.spread_x  = co_moment(x, x);
    line.slope     = co_moment(x, y) / line.spread_x;
    line.intercept = mean(y) - line.slope * mean(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      line.residual += std::pow(y[i] - line.intercept - line.slope * x[i], 2);
    if (x.size() > 2)
      {
        const double                  freedom = x.size() - 2.;
        const boost::math::students_t distribution(freedom);
        const double half = boost::math::quantile(distribution, 0.975) *
                            std::sqrt(line.residual / freedom / line.spread_x);
        line.slope_interval = {line.slope - half, line.slope + half};
      }
    return line;
  }


  std::optional<Correlation>
  correlate(const std::vector<double> &x, const std::vector<double> &y)
  {
    if (x.size() < 3 || !varies(x) || !varies(y))
      return std::nullopt;
    const double n = x.size();
    const double r =
        co_moment(x, y) / std::sqrt(co_moment(x, x) * co_moment(y, y));
    Correlation result;
    result.n_points    = x.size();
    result.coefficient = r;
    const bool on_line = !(std::abs(r) < 1. - 1e-12);
    result.p_value =
        on_line ? 0.
                : two_sided_p(r * std::sqrt((n - 2.) / (1. - r * r)), n - 2.);
    if (n > 3. && !on_line)
      {
        const double half =
            boost::math::quantile(boost::math::normal(), 0.975) /
            std::sqrt(n - 3.);
        result.interval = {std::tanh(std::atanh(r) - half),
                           std::tanh(std::atanh(r) + half)};
      }
    return result;
  }


  std::optional<double>
  p_of_equal_slopes(const Line &first, const Line &second)
  {
    const double freedom  = 1. * first.n_points + second.n_points - 4.;
    const double residual = first.residual + second.residual;
    if (!(freedom > 0.) || !(residual > 0.))
      return std::nullopt;
    const double error = std::sqrt(
        residual / freedom * (1. / first.spread_x + 1. / second.spread_x));
    return two_sided_p((first.slope - second.slope) / error, freedom);
  }


  std::optional<double>
  p_of_equal_correlations(const double       first,
                          const unsigned int n_first,
                          const double       second,
                          const unsigned int n_second)
  {
    if (n_first < 4 || n_second < 4 || !(std::abs(first) < 1.) ||
        !(std::abs(second) < 1.))
      return std::nullopt;
    const double z = (std::atanh(first) - std::atanh(second)) /
                     std::sqrt(1. / (n_first - 3.) + 1. / (n_second - 3.));
    return 2. * boost::math::cdf(boost::math::complement(boost::math::normal(),
                                                         std::abs(z)));
  }
} // namespace Morsel::Study
