#include <morsel/fe/cell_geometry.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>

namespace Morsel::FE
{
  using namespace dealii;

  QuadMap::QuadMap(const std::array<Point<2>, 4> &vertices)
      : vertices(vertices)
      , edge_x(vertices[1] - vertices[0])
      , edge_y(vertices[2] - vertices[0])
      , twist((vertices[3] - vertices[2]) - (vertices[1] - vertices[0]))
      , affine(twist.norm() <= 1e-10 * edge_x.norm())
  {
    // Round-off in the corners must not make a Newton iteration of it.
    if (affine)
      twist = Tensor<1, 2>();
  }


  Point<2>
  QuadMap::to_physical(const Point<2> &reference) const
  {
    return vertices[0] + reference[0] * edge_x + reference[1] * edge_y +
           reference[0] * reference[1] * twist;
  }


  Tensor<2, 2>
  QuadMap::jacobian(const Point<2> &reference) const
  {
    Tensor<2, 2> J;
    for (unsigned int i = 0; i < 2; ++i)
      {
        J[i][0] = edge_x[i] + reference[1] * twist[i];
        J[i][1] = edge_y[i] + reference[0] * twist[i];
      }
    return J;
  }


  Point<2>
  QuadMap::to_reference(const Point<2> &physical) const
  {
    Point<2>           xi(0.5, 0.5);
    const unsigned int n_steps = affine ? 1 : 12;
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        const Tensor<1, 2> change =
            invert(jacobian(xi)) * (physical - to_physical(xi));
        xi += change;
        if (change.norm() < 1e-14)
          break;
      }
    return xi;
  }


  double
  QuadMap::area() const
  {
    const Tensor<1, 2> a = vertices[3] - vertices[0];
    const Tensor<1, 2> b = vertices[2] - vertices[1];
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }


  double
  QuadMap::diameter() const
  {
    return std::max(vertices[3].distance(vertices[0]),
                    vertices[2].distance(vertices[1]));
  }


  LagrangeBasis::LagrangeBasis(const unsigned int degree)
  {
    const QGaussLobatto<1> lobatto(degree + 1);
    for (const Point<1> &p : lobatto.get_points())
      nodes.push_back(p[0]);
    for (unsigned int i = 0; i <= degree; ++i)
      {
        double product = 1.;
        for (unsigned int j = 0; j <= degree; ++j)
          if (j != i)
            product *= nodes[i] - nodes[j];
        scale.push_back(1. / product);
      }
    numbering = FE_Q<2>(degree).get_poly_space_numbering();
  }


  void
  LagrangeBasis::evaluate(const std::vector<Point<2>> &points,
                          Eigen::MatrixXd             &value,
                          Eigen::MatrixXd             &d_xi,
                          Eigen::MatrixXd             &d_eta) const
  {
    const unsigned int n  = nodes.size();
    const unsigned int nq = points.size();
    value.resize(nq, n * n);
    d_xi.resize(nq, n * n);
    d_eta.resize(nq, n * n);
    // Lagrange polynomials as running products from both sides, at all points
    // at once: columns lie in memory one after another.
    Eigen::ArrayXXd v(nq, 2 * n), d(nq, 2 * n), left(nq, n + 1),
        dleft(nq, n + 1), right(nq, n + 1), dright(nq, n + 1);
    Eigen::ArrayXd x(nq);
    for (unsigned int c = 0; c < 2; ++c)
      {
        for (unsigned int q = 0; q < nq; ++q)
          x(q) = points[q][c];
        left.col(0)   = 1.;
        right.col(n)  = 1.;
        dleft.col(0)  = 0.;
        dright.col(n) = 0.;
        for (unsigned int i = 0; i < n; ++i)
          {
            left.col(i + 1)  = left.col(i) * (x - nodes[i]);
            dleft.col(i + 1) = dleft.col(i) * (x - nodes[i]) + left.col(i);
          }
        for (unsigned int i = n; i-- > 0;)
          {
            right.col(i) = right.col(i + 1) * (x - nodes[i]);
            dright.col(i) =
                dright.col(i + 1) * (x - nodes[i]) + right.col(i + 1);
          }
        for (unsigned int i = 0; i < n; ++i)
          {
            v.col(c * n + i) = scale[i] * left.col(i) * right.col(i + 1);
            d.col(c * n + i) = scale[i] * (dleft.col(i) * right.col(i + 1) +
                                           left.col(i) * dright.col(i + 1));
          }
      }
    for (unsigned int k = 0; k < n * n; ++k)
      {
        const unsigned int i = numbering[k] % n, j = numbering[k] / n;
        value.col(k) = v.col(i) * v.col(n + j);
        d_xi.col(k)  = d.col(i) * v.col(n + j);
        d_eta.col(k) = v.col(i) * d.col(n + j);
      }
  }
} // namespace Morsel::FE
