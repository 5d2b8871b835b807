#ifndef morsel_study_regression_h
#define morsel_study_regression_h

#include <optional>
#include <vector>

namespace Morsel::Study
{
  /// Ends of a 95 % confidence interval.
  struct Interval
  {
    double low = 0., high = 0.;
  };


  /// y = intercept + slope x by least squares.
  struct Line
  {
    unsigned int n_points  = 0;
    double       slope     = 0.;
    double       intercept = 0.;
    double       spread_x  = 0.; ///< sum of (x - mean)^2
    double       residual  = 0.; ///< sum of squared residuals

    /// Of the slope, by Student's t with n - 2 degrees of freedom; none for
    /// two points.
    std::optional<Interval> slope_interval;
  };


  /// @param x, y as many of each
  /// @return nothing if fewer than two different x are given
  std::optional<Line>
  fit_line(const std::vector<double> &x, const std::vector<double> &y);


  /// Pearson's correlation coefficient.
  struct Correlation
  {
    unsigned int n_points    = 0;
    double       coefficient = 0.;
    /// By Fisher's z transformation; none for fewer than four points, or on
    /// one line.
    std::optional<Interval> interval;
    /// Two-sided, of no correlation, by Student's t.
    double p_value = 1.;
  };


  /// @param x, y as many of each
  /// @return nothing for fewer than three points, or if x or y is constant
  std::optional<Correlation>
  correlate(const std::vector<double> &x, const std::vector<double> &y);


  /// Two-sided p-value of equal slopes: Student's t with the residuals of both
  /// lines pooled, n1 + n2 - 4 degrees of freedom.
  /// @return nothing if no degree of freedom is left, or no residual
  std::optional<double>
  p_of_equal_slopes(const Line &first, const Line &second);


  /// Two-sided p-value of equal correlations in two samples, by Fisher's z.
  /// @param first, second between -1 and 1
  /// @param n_first, n_second points behind them
  /// @return nothing for fewer than four points on a side
  std::optional<double>
  p_of_equal_correlations(double       first,
                          unsigned int n_first,
                          double       second,
                          unsigned int n_second);
} // namespace Morsel::Study

#endif
