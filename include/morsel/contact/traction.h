#ifndef morsel_contact_traction_h
#define morsel_contact_traction_h

#include <morsel/contact/surface.h>

#include <vector>

namespace Morsel::Contact
{
  /// What a surface feels, node by node.
  struct Traction
  {
    /// Way along the node's loop from the loop's first node, the body to the
    /// left [m].
    std::vector<double> arc;
    /// Outward unit normal, the mean of the node's facets.
    std::vector<dealii::Tensor<1, 2>> normal;
    /// Force per area [Pa].
    std::vector<dealii::Tensor<1, 2>> vector;

    /// Normal pressure, positive in compression [Pa].
    double
    pressure(const unsigned int node) const
    {
      return -(vector[node] * normal[node]);
    }

    /// Tangential traction, positive along the arc [Pa].
    double
    shear(const unsigned int node) const
    {
      return normal[node][0] * vector[node][1] -
             normal[node][1] * vector[node][0];
    }
  };


  /// The traction on a surface from the forces on its nodes. A particle's force
  /// reaches the two nodes beside its foot, but stands for an edge as wide as
  /// the particle: each node's force is spread over the nodes about it by a hat
  /// function of the half width @p width along the arc, which makes an even
  /// row of equal forces at that distance a constant. Traction times tributary
  /// length times depth has the sum of the forces.
  /// @param width of a particle [m]
  /// @param depth out of the plane [m]
  Traction
  traction_of(const Surface &surface, double width, double depth);


  /// A surface's load in a few numbers.
  struct Load
  {
    dealii::Tensor<1, 2> force; ///< [N]
    /// Mean of the places of contact, weighted with the forces there [m];
    /// the middle of the nodes where there is none.
    dealii::Point<2> centre;
    double           peak_pressure  = 0.; ///< [Pa]
    double           contact_length = 0.; ///< see load_on() [m]
  };


  /// @param traction of the surface
  /// The contact length is that where the pressure exceeds a hundredth of its
  /// peak.
  Load
  load_on(const Surface &surface, const Traction &traction);
} // namespace Morsel::Contact

#endif
