#include <morsel/calibrate/search.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace Morsel::Calibrate
{
  namespace
  {
    double
    with_five_digits(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.5g", value);
      return std::strtod(text, nullptr);
    }


    double
    size_of(const std::vector<double> &x)
    {
      double squares = 0.;
      for (const double value : x)
        squares += value * value;
      return std::sqrt(squares);
    }


    std::vector<double>
    logarithms(const std::vector<double> &values)
    {
      std::vector<double> result;
      for (const double value : values)
        result.push_back(std::log(value));
      return result;
    }


    /// The solution of J x = f.
    std::vector<double>
    solve(const std::vector<std::vector<double>> &J,
          const std::vector<double>              &f)
    {
      const unsigned int         n = f.size();
      dealii::FullMatrix<double> matrix(n, n);
      dealii::Vector<double>     right(n), solution(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          right[i] = f[i];
          for (unsigned int j = 0; j < n; ++j)
            matrix(i, j) = J[i][j];
        }
      matrix.gauss_jordan();
      matrix.vmult(solution, right);
      return {solution.begin(), solution.end()};
    }
  } // namespace


  Search::Search(std::vector<double>              start,
                 std::vector<std::vector<double>> exponents)
      : current(std::move(start))
      , first_exponents(exponents)
      , exponents(std::move(exponents))
  {
    for (double &value : current)
      value = with_five_digits(value);
  }


  void
  Search::take(const std::vector<double> &ratios)
  {
    const std::vector<double> x = logarithms(current);
    const std::vector<double> f = logarithms(ratios);
    const unsigned int        n = x.size();

    // A step that did not help says nothing about the slope: noise has.
    if (!last_f.empty() && size_of(f) >= size_of(last_f))
      exponents = first_exponents;
    else if (!last_f.empty())
      {
        double              squares = 0.;
        std::vector<double> dx(n);
        for (unsigned int j = 0; j < n; ++j)
          {
            dx[j] = x[j] - last_x[j];
            squares += dx[j] * dx[j];
          }
        for (unsigned int i = 0; i < n && squares > 0.; ++i)
          {
            double rest = f[i] - last_f[i];
            for (unsigned int j = 0; j < n; ++j)
              rest -= exponents[i][j] * dx[j];
            for (unsigned int j = 0; j < n; ++j)
              exponents[i][j] += rest * dx[j] / squares;
          }
      }
    last_x = x;
    last_f = f;

    // Differences of noisy measures may make a slope as small as one likes.
    std::vector<double> step  = solve(exponents, f);
    const double        limit = 2. * size_of(solve(first_exponents, f));
    if (const double size = size_of(step); size > limit)
      for (double &s : step)
        s *= limit / size;
    const double largest = std::log(2.);
    for (unsigned int j = 0; j < n; ++j)
      current[j] = with_five_digits(
          std::exp(x[j] - std::max(-largest, std::min(largest, step[j]))));
  }
} // namespace Morsel::Calibrate
