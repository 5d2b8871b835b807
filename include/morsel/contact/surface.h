#ifndef morsel_contact_surface_h
#define morsel_contact_surface_h

#include <deal.II/base/point.h>

#include <string>
#include <utility>
#include <vector>

namespace Morsel::Contact
{
  /// The surface of a body that is not made of particles, as contact sees
  /// it: nodes joined by straight facets, outward normal to the left of
  /// the direction second - first turned by -90 degrees (the body lies to
  /// the left when walking from first to second). Contact reads where the
  /// nodes are and how they move, and adds the forces on them; whether a
  /// rigid motion or a finite element solution moves the nodes is not its
  /// concern.
  struct Surface
  {
    std::string                                        name;
    std::vector<dealii::Point<2>>                      nodes;    ///< now [m]
    std::vector<dealii::Tensor<1, 2>>                  velocity; ///< [m/s]
    std::vector<dealii::Tensor<1, 2>>                  force;    ///< [N]
    std::vector<std::pair<unsigned int, unsigned int>> facets;
    /// Facet length that belongs to each node [m].
    std::vector<double> tributary;

    dealii::Tensor<1, 2>
    total_force() const;
  };


  /// Surface of an axis-parallel rectangle, anticlockwise, nodes no further
  /// apart than @p node_spacing [m].
  Surface
  rectangle_surface(const std::string      &name,
                    const dealii::Point<2> &lower,
                    const dealii::Point<2> &upper,
                    double                  node_spacing);


  /// Surface of a polygon, whose holes are loops as well.
  /// @param loops corners of each, the body to the left when walking along
  Surface
  polygon_surface(const std::string                                &name,
                  const std::vector<std::vector<dealii::Point<2>>> &loops,
                  double node_spacing);


  /// Surface of closed polylines, the body to the left of each facet.
  Surface
  polyline_surface(
      const std::string                                        &name,
      const std::vector<dealii::Point<2>>                      &nodes,
      const std::vector<std::pair<unsigned int, unsigned int>> &facets);


  /// Where a point stands to one facet.
  struct Projection
  {
    double               distance;  ///< signed, > 0 outside [m]
    double               offset;    ///< signed, to the facet's line [m]
    dealii::Tensor<1, 2> normal;    ///< unit, from the surface to the point
    double               parameter; ///< 0 at first node, 1 at second
    bool                 interior;  ///< the foot lies inside the facet
  };

  Projection
  project(const Surface          &surface,
          unsigned int            facet,
          const dealii::Point<2> &x);
} // namespace Morsel::Contact

#endif
