#ifndef morsel_calibrate_search_h
#define morsel_calibrate_search_h

#include <vector>

namespace Morsel::Calibrate
{
  /// Finds n positive parameters p that give n positive measures their
  /// targets, by Broyden's method (1965) in the logarithms: with x = log p and
  /// f = log(measure/target),
  ///   x <- x - J^-1 f,   J <- J + (df - J dx) dx^T / |dx|^2.
  /// For one parameter that is the secant method, and exact in the second
  /// round for a power law.
  class Search
  {
  public:
    /// @param start the first parameters, positive
    /// @param exponents row i: how the i-th measure goes with the parameters
    ///   to first order, d log(measure_i)/d log(parameter_j); not singular
    Search(std::vector<double>              start,
           std::vector<std::vector<double>> exponents);

    /// The parameters to try next, each with five digits, so that the value
    /// that is told is the value that was tried.
    const std::vector<double> &
    parameters() const
    {
      return current;
    }

    /// Takes what the present parameters gave, and moves on, by a factor of
    /// two at most, and by at most twice what the first exponents ask for.
    /// @param ratios measure over target, positive
    void
    take(const std::vector<double> &ratios);

  private:
    std::vector<double>                    current;
    const std::vector<std::vector<double>> first_exponents;
    std::vector<std::vector<double>>       exponents;      ///< J
    std::vector<double>                    last_x, last_f; ///< or empty
  };
} // namespace Morsel::Calibrate

#endif
