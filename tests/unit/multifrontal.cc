// Dense elimination front by front against a dense factorisation of the whole.
#include <morsel/core/multifrontal_cholesky.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/Cholesky>

#include <random>

namespace
{
  using namespace Morsel;
  using dealii::Point;

  /// Random positive definite elements of neighbours on a jittered lattice,
  /// and a few that couple all of its far corners.
  struct Elements
  {
    explicit Elements(const unsigned int n)
    {
      std::mt19937                           random(3);
      std::uniform_real_distribution<double> number(-0.3, 0.3);
      for (unsigned int y = 0; y < n; ++y)
        for (unsigned int x = 0; x < 2 * n; ++x)
          points.emplace_back(x + number(random), y + number(random));
      for (const Point<2> &centre : points)
        {
          for (unsigned int j = 0; j < points.size(); ++j)
            if (centre.distance(points[j]) < 2.3)
              nodes.index.push_back(j);
          nodes.start.push_back(nodes.index.size());
        }
      for (const unsigned int j : {0u, 2 * n - 1, 2 * n * n - 1})
        nodes.index.push_back(j);
      nodes.start.push_back(nodes.index.size());
      for (unsigned int e = 0; e < nodes.n_elements(); ++e)
        {
          const unsigned int size = 2 * (nodes.start[e + 1] - nodes.start[e]);
          Eigen::MatrixXd    root(size, 3);
          for (unsigned int k = 0; k < root.size(); ++k)
            root.data()[k] = number(random);
          matrices.push_back(root * root.transpose());
          matrices.back().diagonal().array() += 1e-3;
        }
    }

    Eigen::MatrixXd
    sum() const
    {
      Eigen::MatrixXd result =
          Eigen::MatrixXd::Zero(2 * points.size(), 2 * points.size());
      for (unsigned int e = 0; e < nodes.n_elements(); ++e)
        for (unsigned int i = 0; i < matrices[e].rows(); ++i)
          for (unsigned int j = 0; j < matrices[e].cols(); ++j)
            result(2 * nodes.index[nodes.start[e] + i / 2] + i % 2,
                   2 * nodes.index[nodes.start[e] + j / 2] + j % 2) +=
                matrices[e](i, j);
      return result;
    }

    MultifrontalCholesky::ElementMatrix
    writer() const
    {
      return [this](const unsigned int e, std::vector<double> &matrix) {
        std::copy(matrices[e].data(),
                  matrices[e].data() + matrices[e].size(),
                  matrix.begin());
      };
    }

    std::vector<Point<2>>        points;
    ElementNodes                 nodes;
    std::vector<Eigen::MatrixXd> matrices;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(multifrontal)

BOOST_AUTO_TEST_CASE(multifrontal_solution_is_that_of_a_dense_factorisation)
{
  for (const unsigned int n : {2, 5, 17})
    {
      const Elements             elements(n);
      const Dissection           order(elements.points, elements.nodes);
      const MultifrontalCholesky factors(
          order, elements.nodes, elements.writer());
      BOOST_TEST(factors.succeeded());
      BOOST_TEST((n < 17 || order.fronts.size() > 10));
      const Eigen::VectorXd x =
          Eigen::VectorXd::LinSpaced(2 * elements.points.size(), -1., 2.);
      Eigen::VectorXd y(x.size());
      factors.solve(y.data(), x.data());
      const Eigen::VectorXd dense = elements.sum().llt().solve(x);
      BOOST_TEST((y - dense).norm() < 1e-10 * dense.norm());
    }
}


BOOST_AUTO_TEST_CASE(what_is_not_positive_definite_has_no_factors)
{
  Elements         elements(9);
  const Dissection order(elements.points, elements.nodes);
  elements.matrices[70].diagonal().array() -= 30.;
  BOOST_TEST(!MultifrontalCholesky(order, elements.nodes, elements.writer())
                  .succeeded());
}

BOOST_AUTO_TEST_SUITE_END()
