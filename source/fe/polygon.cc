#include <morsel/fe/polygon.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    bool
    contains(const Polygon &polygon, const Point<2> &p)
    {
      for (unsigned int i = 0; i < polygon.size(); ++i)
        if (cross(polygon[(i + 1) % polygon.size()] - polygon[i],
                  p - polygon[i]) < 0.)
          return false;
      return true;
    }


    Point<2>
    nearest_on_segment(const Point<2> &p, const Point<2> &a, const Point<2> &b)
    {
      const Tensor<1, 2> d = b - a;
      const double       l = d.norm_square();
      return l == 0. ? a : a + std::clamp(((p - a) * d) / l, 0., 1.) * d;
    }
  } // namespace


  double
  polygon_diameter(const Polygon &polygon)
  {
    double d = 0.;
    for (const Point<2> &a : polygon)
      for (const Point<2> &b : polygon)
        d = std::max(d, a.distance(b));
    return d;
  }


  Point<2>
  nearest_in_polygon(const Point<2> &p, const Polygon &polygon)
  {
    if (contains(polygon, p))
      return p;
    Point<2> best;
    double   distance = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < polygon.size(); ++i)
      {
        const Point<2> c = nearest_on_segment(
            p, polygon[i], polygon[(i + 1) % polygon.size()]);
        if (c.distance(p) < distance)
          {
            distance = c.distance(p);
            best     = c;
          }
      }
    return best;
  }


  double
  polygon_area(const Polygon &polygon)
  {
    double area = 0.;
    for (unsigned int i = 1; i + 1 < polygon.size(); ++i)
      area += 0.5 * cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return area;
  }


  std::pair<Polygon, Polygon>
  cut_polygon(const Polygon  &polygon,
              const Point<2> &a,
              const Point<2> &b,
              const double    tolerance)
  {
    const Tensor<1, 2>  direction = (b - a) / (b - a).norm();
    std::vector<double> height;
    for (const Point<2> &p : polygon)
      {
        const double h = cross(direction, p - a);
        height.push_back(std::abs(h) <= tolerance ? 0. : h);
      }
    Polygon left, right;
    for (unsigned int i = 0; i < polygon.size(); ++i)
      {
        const unsigned int j = (i + 1) % polygon.size();
        if (height[i] >= 0.)
          left.push_back(polygon[i]);
        if (height[i] <= 0.)
          right.push_back(polygon[i]);
        if ((height[i] > 0. && height[j] < 0.) ||
            (height[i] < 0. && height[j] > 0.))
          {
            const double   t = height[i] / (height[i] - height[j]);
            const Point<2> p = polygon[i] + t * (polygon[j] - polygon[i]);
            left.push_back(p);
            right.push_back(p);
          }
      }
    const auto drop_if_flat = [&](Polygon &part) {
      if (part.size() < 3)
        part.clear();
    };
    drop_if_flat(left);
    drop_if_flat(right);
    return {left, right};
  }


  double
  distance_to_polygon(const Point<2> &p, const Polygon &polygon)
  {
    return p.distance(nearest_in_polygon(p, polygon));
  }


  double
  distance_to_polygon(const Fracture::Crack &crack, const Polygon &polygon)
  {
    const auto &v    = crack.get_vertices();
    Polygon     loop = polygon;
    loop.push_back(polygon[0]);
    double best = std::numeric_limits<double>::max();
    for (unsigned int s = 0; s + 1 < v.size(); ++s)
      {
        if (contains(polygon, v[s]) || contains(polygon, v[s + 1]))
          return 0.;
        for (unsigned int i = 0; i + 1 < loop.size(); ++i)
          {
            const double pa = cross(v[s + 1] - v[s], loop[i] - v[s]);
            const double pb = cross(v[s + 1] - v[s], loop[i + 1] - v[s]);
            const double ap = cross(loop[i + 1] - loop[i], v[s] - loop[i]);
            const double bp = cross(loop[i + 1] - loop[i], v[s + 1] - loop[i]);
            if (pa * pb < 0. && ap * bp < 0.)
              return 0.;
            using Fracture::distance_to_segment;
            best =
                std::min({best,
                          distance_to_segment(v[s], loop[i], loop[i + 1]),
                          distance_to_segment(v[s + 1], loop[i], loop[i + 1]),
                          distance_to_segment(loop[i], v[s], v[s + 1])});
          }
      }
    return best;
  }


  std::vector<Polygon>
  cut_into_pieces(const Polygon                      &polygon,
                  const std::vector<Fracture::Crack> &cracks)
  {
    const double         size      = polygon_diameter(polygon);
    const double         tolerance = 1e-10 * size;
    std::vector<Polygon> pieces(1, polygon);
    for (const Fracture::Crack &crack : cracks)
      {
        const auto &v = crack.get_vertices();
        for (unsigned int s = 0; s + 1 < v.size(); ++s)
          {
            const Fracture::Crack segment({v[s], v[s + 1]}, true, true);
            if (distance_to_polygon(segment, polygon) > 1e-6 * size)
              continue;
            std::vector<Polygon> cut;
            for (const Polygon &piece : pieces)
              {
                const auto [left, right] =
                    cut_polygon(piece, v[s], v[s + 1], tolerance);
                if (left.empty() || right.empty())
                  cut.push_back(piece);
                else
                  {
                    cut.push_back(left);
                    cut.push_back(right);
                  }
              }
            pieces.swap(cut);
          }
      }
    return pieces;
  }
} // namespace Morsel::FE
