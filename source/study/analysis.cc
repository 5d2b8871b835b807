#include <morsel/study/analysis.h>
#include <morsel/study/regression.h>

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
    const auto line = fit_line(x, y);
    if (!line)
      return std::nullopt;
    RateFit fit;
    fit.rate     = -line->slope;
    fit.constant = std::exp(line->intercept);
    fit.n_points = line->n_points;
    if (line->slope_interval)
      {
        fit.low  = -line->slope_interval->high;
        fit.high = -line->slope_interval->low;
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
