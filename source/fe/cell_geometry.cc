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
    // Lagrange polynomials as running products from both sides.
    std::vector<double> v(2 * n), d(2 * n), left(n + 1), dleft(n + 1),
        right(n + 1), dright(n + 1);
    for (unsigned int q = 0; q < nq; ++q)
      {
        for (unsigned int c = 0; c < 2; ++c)
          {
            const double x = points[q][c];
            left[0] = right[n] = 1.;
            dleft[0] = dright[n] = 0.;
            for (unsigned int i = 0; i < n; ++i)
              {
                left[i + 1]  = left[i] * (x - nodes[i]);
                dleft[i + 1] = dleft[i] * (x - nodes[i]) + left[i];
              }
            for (unsigned int i = n; i-- > 0;)
              {
                right[i]  = right[i + 1] * (x - nodes[i]);
                dright[i] = dright[i + 1] * (x - nodes[i]) + right[i + 1];
              }
            for (unsigned int i = 0; i < n; ++i)
              {
                v[c * n + i] = scale[i] * left[i] * right[i + 1];
                d[c * n + i] = scale[i] * (dleft[i] * right[i + 1] +
                                           left[i] * dright[i + 1]);
              }
          }
        for (unsigned int k = 0; k < n * n; ++k)
          {
            const unsigned int i = numbering[k] % n, j = numbering[k] / n;
            value(q, k) = v[i] * v[n + j];
            d_xi(q, k)  = d[i] * v[n + j];
            d_eta(q, k) = v[i] * d[n + j];
          }
      }
  }
} // namespace Morsel::FE
