#ifndef morsel_study_analysis_h
#define morsel_study_analysis_h

#include <optional>
#include <vector>

namespace Morsel::Study
{
  /// Least squares of log(error) over log(resolution):
  /// error = constant * resolution^-rate.
  struct RateFit
  {
    double       rate     = 0.;
    double       constant = 0.;
    unsigned int n_points = 0;
    /// Ends of the 95 % confidence interval of the rate, by Student's t with
    /// n - 2 degrees of freedom; none for two points.
    std::optional<double> low, high;
  };


  /// Fits the rate to the points whose errors and resolutions are positive.
  /// @param resolution, error as many of each
  /// @return nothing if fewer than two different resolutions are left
  std::optional<RateFit>
  fit_rate(const std::vector<double> &resolution,
           const std::vector<double> &error);


  /// The indices of the points than which no other one is better in one of
  /// cost and error and at least as good in the other, by rising cost. Of equal
  /// points the first one stands for all.
  std::vector<unsigned int>
  pareto_front(const std::vector<double> &cost,
               const std::vector<double> &error);


  /// What it costs to reach an error.
  struct CostToReach
  {
    enum class Kind
    {
      interpolated, ///< between two runs, linear in the logarithms
      at_most,      ///< already the cheapest run is as good
      not_reached
    };
    Kind   kind = Kind::not_reached;
    double cost = 0.; ///< in the unit of the costs
  };


  /// The cost from which on all runs have at most this error: one lucky run
  /// does not count.
  /// @param cost, error positive, as many of each, in any order
  CostToReach
  cost_to_reach(const std::vector<double> &cost,
                const std::vector<double> &error,
                double                     level);


  /// Figures of a sample.
  struct Statistics
  {
    unsigned int n      = 0;
    double       mean   = 0.;
    double       sd     = 0.; ///< with n - 1; 0 for one value
    double       median = 0.;
    double       low = 0., high = 0.; ///< smallest and largest
  };


  /// @param sample not empty
  Statistics
  statistics_of(std::vector<double> sample);
} // namespace Morsel::Study

#endif
