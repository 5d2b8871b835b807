#include <morsel/core/errors.h>
#include <morsel/fracture/crack.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }


    Tensor<1, 2>
    left_normal(const Tensor<1, 2> &direction)
    {
      return Tensor<1, 2>({-direction[1], direction[0]});
    }


    /// Whether the open segments pq and ab cross in one point. The two
    /// orientation products are compared with zero exactly: a point on the
    /// line counts as lying on neither side.
    bool
    segments_cross(const Point<2> &p,
                   const Point<2> &q,
                   const Point<2> &a,
                   const Point<2> &b)
    {
      const double pa = cross(b - a, p - a);
      const double qa = cross(b - a, q - a);
      if (!((pa > 0. && qa < 0.) || (pa < 0. && qa > 0.)))
        return false;
      const double ap = cross(q - p, a - p);
      const double bp = cross(q - p, b - p);
      return (ap >= 0. && bp <= 0.) || (ap <= 0. && bp >= 0.);
    }


    double
    distance_of_segments(const Point<2> &p,
                         const Point<2> &q,
                         const Point<2> &a,
                         const Point<2> &b)
    {
      if (segments_cross(p, q, a, b))
        return 0.;
      return std::min({distance_to_segment(p, a, b),
                       distance_to_segment(q, a, b),
                       distance_to_segment(a, p, q),
                       distance_to_segment(b, p, q)});
    }
  } // namespace


  double
  distance_to_segment(const Point<2> &p, const Point<2> &a, const Point<2> &b)
  {
    const Tensor<1, 2> d = b - a;
    const double       t = std::clamp(((p - a) * d) / d.norm_square(), 0., 1.);
    return (p - (a + t * d)).norm();
  }


  Crack::Crack(const std::vector<Point<2>> &vertices,
               const bool                   tip_at_first,
               const bool                   tip_at_last)
      : vertices(vertices)
      , tip_at_first(tip_at_first)
      , tip_at_last(tip_at_last)
  {
    if (vertices.size() < 2)
      throw InputError("A crack needs at least two points, but " +
                       std::to_string(vertices.size()) + " is given.");
    for (unsigned int s = 0; s + 1 < vertices.size(); ++s)
      {
        if (vertices[s].distance(vertices[s + 1]) == 0.)
          {
            std::ostringstream message;
            message << "A crack has a segment of zero length at ("
                    << vertices[s] << ") m: give two different points.";
            throw InputError(message.str());
          }
        for (unsigned int t = s + 2; t + 1 < vertices.size(); ++t)
          if (distance_of_segments(
                  vertices[s], vertices[s + 1], vertices[t], vertices[t + 1]) ==
              0.)
            throw InputError("A crack crosses itself: its segments " +
                             std::to_string(s) + " and " + std::to_string(t) +
                             " meet.");
      }
  }


  double
  Crack::length() const
  {
    double sum = 0.;
    for (unsigned int s = 0; s + 1 < vertices.size(); ++s)
      sum += vertices[s].distance(vertices[s + 1]);
    return sum;
  }


  std::vector<CrackTip>
  Crack::tips() const
  {
    std::vector<CrackTip> result;
    const auto            add =
        [&](const Point<2> &tip, const Point<2> &behind, const unsigned end) {
          const Tensor<1, 2> d = tip - behind;
          CrackTip           t;
          t.position  = tip;
          t.direction = d / d.norm();
          t.end       = end;
          t.segment   = d.norm();
          result.push_back(t);
        };
    if (tip_at_first)
      add(vertices[0], vertices[1], 0);
    if (tip_at_last)
      add(vertices.back(), vertices[vertices.size() - 2], 1);
    return result;
  }


  Crack
  Crack::with_extended_mouths(const double overhang) const
  {
    Crack              copy(*this);
    const unsigned int n     = vertices.size();
    const Tensor<1, 2> first = vertices[0] - vertices[1];
    const Tensor<1, 2> last  = vertices[n - 1] - vertices[n - 2];
    if (!tip_at_first)
      copy.vertices[0] += overhang * first / first.norm();
    if (!tip_at_last)
      copy.vertices[n - 1] += overhang * last / last.norm();
    return copy;
  }


  Crack
  Crack::with_moved_tips(const double growth) const
  {
    Crack              copy(*this);
    const unsigned int n     = vertices.size();
    const Tensor<1, 2> first = vertices[0] - vertices[1];
    const Tensor<1, 2> last  = vertices[n - 1] - vertices[n - 2];
    if (tip_at_first)
      copy.vertices[0] += growth * first / first.norm();
    if (tip_at_last)
      copy.vertices[n - 1] += growth * last / last.norm();
    return copy;
  }


  double
  Crack::signed_distance(const Point<2> &p) const
  {
    // The nearest point of the polyline decides: inside a segment its line
    // gives side and distance, beyond an end the line of the end's segment,
    // at a kink the sum of the two normals gives the side.
    const unsigned int n_segments = vertices.size() - 1;
    double             nearest    = std::numeric_limits<double>::max();
    double             result     = 0.;
    for (unsigned int s = 0; s < n_segments; ++s)
      {
        const Tensor<1, 2> d = vertices[s + 1] - vertices[s];
        const double       l = d.norm();
        const double       t = ((p - vertices[s]) * d) / (l * l);
        const double r = distance_to_segment(p, vertices[s], vertices[s + 1]);
        if (r >= nearest)
          continue;
        nearest           = r;
        const bool before = t < 0. && s > 0;
        const bool after  = t > 1. && s + 1 < n_segments;
        if (!before && !after)
          {
            result = cross(d, p - vertices[s]) / l;
            continue;
          }
        const unsigned int v   = before ? s : s + 1;
        const Tensor<1, 2> in  = vertices[v] - vertices[v - 1];
        const Tensor<1, 2> out = vertices[v + 1] - vertices[v];
        const Tensor<1, 2> normal =
            left_normal(in) / in.norm() + left_normal(out) / out.norm();
        result = (p - vertices[v]) * normal < 0. ? -r : r;
      }
    return result;
  }


  double
  Crack::distance(const Point<2> &p) const
  {
    double best = std::numeric_limits<double>::max();
    for (unsigned int s = 0; s + 1 < vertices.size(); ++s)
      best =
          std::min(best, distance_to_segment(p, vertices[s], vertices[s + 1]));
    return best;
  }


  bool
  Crack::separates(const Point<2> &p, const Point<2> &q) const
  {
    for (unsigned int s = 0; s + 1 < vertices.size(); ++s)
      if (segments_cross(p, q, vertices[s], vertices[s + 1]))
        return true;
    return false;
  }


  double
  Crack::distance(const Crack &other) const
  {
    double best = std::numeric_limits<double>::max();
    for (unsigned int s = 0; s + 1 < vertices.size(); ++s)
      for (unsigned int t = 0; t + 1 < other.vertices.size(); ++t)
        best = std::min(best,
                        distance_of_segments(vertices[s],
                                             vertices[s + 1],
                                             other.vertices[t],
                                             other.vertices[t + 1]));
    return best;
  }


  std::vector<CrackTip>
  collect_tips(const std::vector<Crack> &cracks)
  {
    std::vector<CrackTip> all;
    for (unsigned int c = 0; c < cracks.size(); ++c)
      for (CrackTip tip : cracks[c].tips())
        {
          tip.crack = c;
          all.push_back(tip);
        }
    return all;
  }
} // namespace Morsel::Fracture
