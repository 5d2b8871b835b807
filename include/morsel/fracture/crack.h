#ifndef morsel_fracture_crack_h
#define morsel_fracture_crack_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Morsel::Fracture
{
  /// One tip of a crack and the frame that its fields are written in:
  /// x_1 ahead of the tip, x_2 to its left.
  struct CrackTip
  {
    dealii::Point<2>     position;     ///< [m]
    dealii::Tensor<1, 2> direction;    ///< unit vector out of the crack
    unsigned int         crack   = 0;  ///< index of the crack
    unsigned int         end     = 0;  ///< 0: first vertex, 1: last vertex
    double               segment = 0.; ///< length of the tip's segment [m]

    /// Coordinates of a point in the tip's frame [m].
    dealii::Tensor<1, 2>
    to_local(const dealii::Point<2> &p) const
    {
      const dealii::Tensor<1, 2> d = p - position;
      return dealii::Tensor<1, 2>(
          {d * direction, d[1] * direction[0] - d[0] * direction[1]});
    }

    /// Components in the tip's frame of a vector given in the global one.
    dealii::Tensor<1, 2>
    rotate(const dealii::Tensor<1, 2> &v) const
    {
      return dealii::Tensor<1, 2>(
          {v * direction, v[1] * direction[0] - v[0] * direction[1]});
    }
  };


  /// A crack in the plane: a polyline whose ends are tips, or mouths where it
  /// meets the boundary of the body. It knows nothing of any mesh.
  class Crack
  {
  public:
    /// @param vertices the polyline, two points or more, no two neighbours
    ///   equal [m]
    /// @param tip_at_first, tip_at_last whether the crack ends there inside
    ///   the body
    /// @throws InputError if there are fewer than two points, or the crack
    ///   has no length, or it crosses itself
    Crack(const std::vector<dealii::Point<2>> &vertices,
          const bool                           tip_at_first,
          const bool                           tip_at_last);

    const std::vector<dealii::Point<2>> &
    get_vertices() const
    {
      return vertices;
    }

    double
    length() const;

    /// The crack's tips, first end first.
    std::vector<CrackTip>
    tips() const;

    /// Whether the crack ends in a tip at its first (0) or last (1) vertex.
    bool
    has_tip(const unsigned int end) const
    {
      return end == 0 ? tip_at_first : tip_at_last;
    }

    /// The crack with its mouths carried on by @p overhang beyond the
    /// boundary of the body [m], so that it cuts the outermost cells through.
    Crack
    with_extended_mouths(const double overhang) const;

    /// The crack with its tips moved ahead by @p growth [m] (a negative
    /// growth shortens it).
    Crack
    with_moved_tips(const double growth) const;

    /// Signed distance to the polyline carried on beyond its ends: positive
    /// on the left of its direction [m]. At a kink the side is that of the
    /// sum of the two normals, which is continuous off the crack.
    double
    signed_distance(const dealii::Point<2> &p) const;

    /// Distance to the crack itself [m].
    double
    distance(const dealii::Point<2> &p) const;

    /// Whether the straight line from p to q crosses the crack: the
    /// visibility criterion. A line that touches the crack with one end, or
    /// runs along it, does not cross it.
    bool
    separates(const dealii::Point<2> &p, const dealii::Point<2> &q) const;

    /// Smallest distance between this crack and another one, 0 where they
    /// cross [m].
    double
    distance(const Crack &other) const;

  private:
    std::vector<dealii::Point<2>> vertices;
    bool                          tip_at_first;
    bool                          tip_at_last;
  };


  /// Distance from a point to the straight segment from a to b [m].
  double
  distance_to_segment(const dealii::Point<2> &p,
                      const dealii::Point<2> &a,
                      const dealii::Point<2> &b);


  /// All tips of a set of cracks, with their crack's index.
  std::vector<CrackTip>
  collect_tips(const std::vector<Crack> &cracks);
} // namespace Morsel::Fracture

#endif
