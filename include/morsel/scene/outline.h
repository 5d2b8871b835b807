#ifndef morsel_scene_outline_h
#define morsel_scene_outline_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// The boundary of a body in the plane: closed loops of straight edges, one
  /// around the body and others around its holes. Edges belong to named sides.
  class Outline
  {
  public:
    /// The body lies on the left of its edges.
    struct Edge
    {
      dealii::Point<2> first, second; ///< [m]
      unsigned int     side = 0;

      double
      length() const
      {
        return first.distance(second);
      }

      /// Unit vector from first to second.
      dealii::Tensor<1, 2>
      direction() const
      {
        return (second - first) / length();
      }
    };

    /// Corners of a closed loop and the side of the edge from each to the
    /// next one.
    struct Loop
    {
      std::vector<dealii::Point<2>> corners; ///< [m]
      std::vector<unsigned int>     sides;
    };

    Outline() = default;

    /// Loops in any order and direction; the largest one goes around the body.
    /// @throws InputError with a clause that says what is wrong: fewer than
    ///   three corners, an edge without length, loops that meet themselves or
    ///   each other, a hole outside of the body
    Outline(std::vector<Loop> loops, std::vector<std::string> side_names);

    /// Sides left, right, bottom, top.
    static Outline
    rectangle(const dealii::Point<2> &lower, const dealii::Point<2> &upper);

    /// All edges, those of a loop one after the other.
    const std::vector<Edge> &
    get_edges() const
    {
      return edges;
    }

    /// First edge of each loop, and the number of edges.
    const std::vector<unsigned int> &
    loop_starts() const
    {
      return starts;
    }

    const std::vector<std::string> &
    get_side_names() const
    {
      return names;
    }

    /// The side's number, or that of sides if there is none of that name.
    unsigned int
    side_named(const std::string &name) const;

    /// Corners of the bounding box [m].
    dealii::Point<2>
    lower() const;
    dealii::Point<2>
    upper() const;

    /// [m^2], less the holes.
    double
    area() const;

    /// Whether a point lies inside; on an edge either may be said.
    bool
    contains(const dealii::Point<2> &p) const;

    /// Distance to the nearest edge [m].
    double
    distance(const dealii::Point<2> &p) const;

    /// The edges that straight lines between points of the body may cross:
    /// all, or none of a convex body's.
    std::vector<Edge>
    walls() const;

  private:
    bool
    is_convex() const;

    std::vector<Edge>         edges;
    std::vector<unsigned int> starts;
    std::vector<std::string>  names;
  };


  /// The outline of a mesh, whose boundary faces become edges and whose
  /// boundary ids become sides: named as Gmsh's physical lines are, else
  /// "boundary 0" and so on. Faces in line are joined.
  /// @param file in any format that deal.II reads by its ending
  /// @throws InputError, one sentence, if it is no mesh of the plane
  Outline
  outline_of_mesh(const std::string &file);


  /// How two outlines stand to each other.
  struct Separation
  {
    /// Shortest distance, or, if the bodies overlap, less the distance to the
    /// other boundary of what lies deepest inside of it [m].
    double           gap;
    dealii::Point<2> where; ///< there, on one of the outlines [m]
  };

  /// Looks at points all along both outlines, some hundreds of each.
  Separation
  separation(const Outline &a, const Outline &b);
} // namespace Morsel::Scene

#endif
