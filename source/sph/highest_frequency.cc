#include <morsel/sph/highest_frequency.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace Morsel::SPH
{
  namespace
  {
    using Field = std::vector<Vector2>;

    constexpr unsigned int most_steps = 60;


    double
    product_of(const Field &a, const Field &b, const std::vector<double> &mass)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < mass.size(); ++i)
        sum += mass[i] * (a[i].x * b[i].x + a[i].y * b[i].y);
      return sum;
    }


    void
    add(const double factor, const Field &a, Field &sum)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        {
          sum[i].x += factor * a[i].x;
          sum[i].y += factor * a[i].y;
        }
    }


    void
    scale(const double factor, Field &a)
    {
      for (Vector2 &v : a)
        v = {factor * v.x, factor * v.y};
    }
  } // namespace


  Field
  random_field(const std::vector<unsigned long long> &ids)
  {
    std::vector<unsigned int> order(ids.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return ids[a] < ids[b];
    });
    Field              field(ids.size());
    std::mt19937       generator(1);
    unsigned long long drawn = 0; // by particles so far
    for (const unsigned int i : order)
      {
        generator.discard(2 * (ids[i] - drawn));
        drawn      = ids[i] + 1;
        field[i].x = generator() / 4294967295. - 0.5;
        field[i].y = generator() / 4294967295. - 0.5;
      }
    return field;
  }


  double
  square_of_highest_frequency(
      const std::function<void(const Field &, Field &)> &acceleration,
      Field                                              start,
      const std::vector<double>                         &mass,
      const double                                       tolerance,
      const std::function<double(double)>               &sum)
  {
    const auto product = [&](const Field &a, const Field &b) {
      const double mine = product_of(a, b, mass);
      return sum ? sum(mine) : mine;
    };
    Field v(std::move(start)), last(mass.size(), {0., 0.}), w(mass.size());
    scale(1. / std::sqrt(product(v, v)), v);

    std::vector<double> diagonal, side;
    double              bound = 0.;
    while (diagonal.size() < most_steps)
      {
        acceleration(v, w);
        scale(-1., w);
        diagonal.push_back(product(v, w));
        add(-diagonal.back(), v, w);
        if (!side.empty())
          add(-side.back(), last, w);
        const double beta = std::sqrt(product(w, w));

        const unsigned int                             n = diagonal.size();
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> tridiagonal;
        const Eigen::VectorXd a = Eigen::Map<Eigen::VectorXd>(&diagonal[0], n);
        const Eigen::VectorXd b =
            Eigen::Map<Eigen::VectorXd>(side.data(), n - 1);
        tridiagonal.computeFromTridiagonal(a, b);
        const double largest = tridiagonal.eigenvalues()[n - 1];
        const double residual =
            beta * std::abs(tridiagonal.eigenvectors()(n - 1, n - 1));
        bound = largest + residual;
        if (residual <= tolerance * largest)
          break;
        side.push_back(beta);
        last.swap(v);
        v.swap(w);
        scale(1. / beta, v);
      }
    return bound;
  }
} // namespace Morsel::SPH
