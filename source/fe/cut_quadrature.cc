#include <morsel/fe/cut_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Points of a triangle (apex, a, b) seen from its apex.
    /// @param scale distance of the singular point from the apex [m]
    void
    add_fan_triangle(const Point<2>    &apex,
                     const Point<2>    &a,
                     const Point<2>    &b,
                     const double       scale,
                     const unsigned int n,
                     CellQuadrature    &quadrature)
    {
      const Tensor<1, 2> ea         = a - apex;
      const Tensor<1, 2> eb         = b - apex;
      const double       twice_area = cross(ea, eb);
      const double       reach      = std::max(ea.norm(), eb.norm());
      if (twice_area <= 1e-30 * reach * reach)
        return;

      // Radial intervals: [0, 1] with rho = s^2, which makes half-integer
      // powers of the radius polynomials; away from the singular point plain
      // intervals that grow with the distance from it.
      std::vector<double> limits(1, 0.);
      const double        relative = scale / reach;
      if (relative > 1e-12)
        for (double l = relative; l < 0.5; l *= 3.)
          limits.push_back(l);
      limits.push_back(1.);

      const double round_off =
          4. * std::numeric_limits<double>::epsilon() * apex.norm();
      const GaussRule &radial  = gauss_rule(2 * n - 2);
      const GaussRule &plain   = gauss_rule(n + 1);
      const GaussRule &angular = gauss_rule(n);
      for (unsigned int k = 0; k + 1 < limits.size(); ++k)
        {
          const bool       singular = limits.size() == 2 && relative <= 1e-12;
          const GaussRule &rule     = singular ? radial : plain;
          const double     width    = limits[k + 1] - limits[k];
          for (unsigned int i = 0; i < rule.points.size(); ++i)
            {
              const double s   = rule.points[i];
              const double rho = singular ? s * s : limits[k] + width * s;
              const double w   = rule.weights[i] * (singular ? 2. * s : width);
              for (unsigned int j = 0; j < angular.points.size(); ++j)
                {
                  const double       t      = angular.points[j];
                  const Tensor<1, 2> offset = rho * ((1. - t) * ea + t * eb);
                  // What falls on the singular point by round-off has no value
                  // there, and hardly a weight.
                  if (offset.norm() <= round_off)
                    continue;
                  quadrature.points.push_back(apex + offset);
                  quadrature.weights.push_back(w * angular.weights[j] * rho *
                                               twice_area);
                }
            }
        }
    }


    /// Splits the edge ab until it is seen from the apex under a moderate
    /// angle and at distances of one order: the integrand then varies slowly
    /// along it however close the apex lies.
    void
    add_fan(const Point<2>    &apex,
            const Point<2>    &a,
            const Point<2>    &b,
            const double       scale,
            const unsigned int n,
            CellQuadrature    &quadrature,
            const unsigned int depth = 0)
    {
      const Tensor<1, 2> ea = a - apex;
      const Tensor<1, 2> eb = b - apex;
      const double       ra = ea.norm(), rb = eb.norm();
      const double       far = std::max(ra, rb);
      // Nothing is left of a triangle thinner than the coordinates' round-off.
      const double thin =
          1e-13 * far +
          8. * std::numeric_limits<double>::epsilon() * apex.norm();
      if (std::min(ra, rb) <= thin || std::abs(cross(ea, eb)) <= thin * far)
        return;
      const double cosine = (ea * eb) / (ra * rb);
      if (depth < 30 && (cosine < 0.4 || far > 2.5 * std::min(ra, rb)))
        {
          // Split at the foot of the perpendicular if it is inside, else
          // where the distance is the geometric mean of the two ends'.
          const Tensor<1, 2> e      = b - a;
          const double       length = e.norm();
          const double       sa     = (ea * e) / length;
          const double       sb     = (eb * e) / length;
          const double       height = std::abs(cross(ea, e)) / length;
          double             sm     = 0.;
          if (sa > -1e-9 * length || sb < 1e-9 * length)
            {
              const double reach =
                  std::sqrt(std::max(0., ra * rb - height * height));
              sm = sa > -1e-9 * length ? reach : -reach;
            }
          const double t = (sm - sa) / length;
          if (t > 1e-12 && t < 1. - 1e-12)
            {
              const Point<2> m = a + t * e;
              add_fan(apex, a, m, scale, n, quadrature, depth + 1);
              add_fan(apex, m, b, scale, n, quadrature, depth + 1);
              return;
            }
        }
      add_fan_triangle(apex, a, b, scale, n, quadrature);
    }


    void
    add_triangle(const Point<2>    &a,
                 const Point<2>    &b,
                 const Point<2>    &c,
                 const unsigned int n,
                 CellQuadrature    &quadrature)
    {
      const double twice_area = cross(b - a, c - a);
      if (twice_area <= 0.)
        return;
      const GaussRule &radial = gauss_rule(n + 1);
      const GaussRule &along  = gauss_rule(n);
      for (unsigned int i = 0; i < radial.points.size(); ++i)
        for (unsigned int j = 0; j < along.points.size(); ++j)
          {
            const double s = radial.points[i], t = along.points[j];
            quadrature.points.push_back(a +
                                        s * ((1. - t) * (b - a) + t * (c - a)));
            quadrature.weights.push_back(radial.weights[i] * along.weights[j] *
                                         s * twice_area);
          }
    }
  } // namespace


  const GaussRule &
  gauss_rule(const unsigned int n)
  {
    static std::array<GaussRule, 65> rules;
    static std::mutex                mutex;
    AssertIndexRange(n, rules.size());
    const std::lock_guard<std::mutex> lock(mutex);
    if (rules[n].points.empty())
      {
        const QGauss<1> gauss(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            rules[n].points.push_back(gauss.point(i)[0]);
            rules[n].weights.push_back(gauss.weight(i));
          }
      }
    return rules[n];
  }


  CellQuadrature
  gauss_quadrature(const QuadMap &map, const unsigned int n)
  {
    const GaussRule &rule = gauss_rule(n);
    CellQuadrature   quadrature;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const Point<2> xi(rule.points[i], rule.points[j]);
          quadrature.reference.push_back(xi);
          quadrature.points.push_back(map.to_physical(xi));
          quadrature.weights.push_back(rule.weights[i] * rule.weights[j] *
                                       determinant(map.jacobian(xi)));
        }
    return quadrature;
  }


  CellQuadrature
  cut_quadrature(const QuadMap               &map,
                 const std::vector<Polygon>  &pieces,
                 const std::vector<Point<2>> &tips,
                 const unsigned int           n)
  {
    CellQuadrature quadrature;
    for (const Polygon &piece : pieces)
      {
        const double size     = polygon_diameter(piece);
        double       distance = std::numeric_limits<double>::max();
        Point<2>     apex;
        for (const Point<2> &tip : tips)
          {
            const Point<2> c = nearest_in_polygon(tip, piece);
            if (c.distance(tip) < distance)
              {
                distance = c.distance(tip);
                apex     = c;
              }
          }
        // Beyond that a Gauss rule of this order converges fast enough: by
        // (z + sqrt(z^2 - 1))^(-2n) with z = 1 + 2 distance/width.
        if (distance < 0.2 * size)
          for (unsigned int i = 0; i < piece.size(); ++i)
            add_fan(apex,
                    piece[i],
                    piece[(i + 1) % piece.size()],
                    distance > 1e-12 * size ? distance : 0.,
                    n,
                    quadrature);
        else if (pieces.size() == 1)
          return gauss_quadrature(map, n);
        else
          for (unsigned int i = 1; i + 1 < piece.size(); ++i)
            add_triangle(piece[0], piece[i], piece[i + 1], n, quadrature);
      }
    quadrature.reference.reserve(quadrature.points.size());
    for (const Point<2> &p : quadrature.points)
      quadrature.reference.push_back(map.to_reference(p));
    return quadrature;
  }
} // namespace Morsel::FE
