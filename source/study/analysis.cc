#include <morsel/study/analysis.h>

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::Study
{
  namespace
  {
    /// Indices by rising cost; of equal costs the smaller error comes first.
    std::vector<unsigned int>
    by_cost(const std::vector<double> &cost, const std::vector<double> &error)
    {
      std::vector<unsigned int> order(cost.size());
      std::iota(order.begin(), order.end(), 0u);
      std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
        return cost[a] != cost[b] ? cost[a] < cost[b] : error[a] < error[b];
      });
      return order;
    }
  } // namespace


  std::optional<RateFit>
  fit_rate(const std::vector<double> &resolution,
           const std::vector<double> &error)
  {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < error.size(); ++i)
      if (error[i] > 0. && resolution[i] > 0.)
        {
          x.push_back(std::log(resolution[i]));
          y.push_back(std::log(error[i]));
        }
    const double n = x.size();
    if (x.size() < 2)
      return std::nullopt;
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.) / n;
    const double mean_y = std::accumulate(y.begin(), y.end(), 0.) / n;
    double       xx = 0., xy = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
      }
    if (!(xx > 1e-20 * (1. + mean_x * mean_x)))
      return std::nullopt;

    RateFit      fit;
    const double slope = xy / xx;
    fit.rate           = -slope;
    fit.constant       = std::exp(mean_y - slope * mean_x);
    fit.n_points       = x.size();
    if (x.size() > 2)
      {
        double rest = 0.;
        for (std::size_t i = 0; i < x.size(); ++i)
          rest += std::pow(y[i] - mean_y - slope * (x[i] - mean_x), 2);
        const boost::math::students_t distribution(n - 2.);
        const double half = boost::math::quantile(distribution, 0.975) *
                            std::sqrt(rest / (n - 2.) / xx);
        fit.low  = fit.rate - half;
        fit.high = fit.rate + half;
      }
    return fit;
  }


  std::vector<unsigned int>
  pareto_front(const std::vector<double> &cost,
               const std::vector<double> &error)
  {
    std::vector<unsigned int> front;
    for (const unsigned int i : by_cost(cost, error))
      if (front.empty() || error[i] < error[front.back()])
        front.push_back(i);
    return front;
  }


  CostToReach
  cost_to_reach(const std::vector<double> &cost,
                const std::vector<double> &error,
                const double               level)
  {
    const std::vector<unsigned int> order = by_cost(cost, error);
    // The dearest run whose error is too large, and the one after it.
    unsigned int first_good = order.size();
    while (first_good > 0 && error[order[first_good - 1]] <= level)
      --first_good;
    if (first_good == order.size())
      return {};
    const unsigned int good = order[first_good];
    if (first_good == 0)
      return {CostToReach::Kind::at_most, cost[good]};
    const unsigned int bad = order[first_good - 1];
    const double       t   = error[good] > 0. ? std::log(error[bad] / level) /
                                            std::log(error[bad] / error[good])
                                              : 1.;
    return {CostToReach::Kind::interpolated,
            cost[bad] * std::pow(cost[good] / cost[bad], t)};
  }


  Statistics
  statistics_of(std::vector<double> sample)
  {
    std::sort(sample.begin(), sample.end());
    Statistics   s;
    const double n = sample.size();
    s.n            = sample.size();
    s.mean         = std::accumulate(sample.begin(), sample.end(), 0.) / n;
    double squares = 0.;
    for (const double x : sample)
      squares += (x - s.mean) * (x - s.mean);
    s.sd     = s.n > 1 ? std::sqrt(squares / (n - 1.)) : 0.;
    s.median = 0.5 * (sample[(s.n - 1) / 2] + sample[s.n / 2]);
    s.low    = sample.front();
    s.high   = sample.back();
    return s;
  }
} // namespace Morsel::Study
