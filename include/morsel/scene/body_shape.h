#ifndef morsel_scene_body_shape_h
#define morsel_scene_body_shape_h

#include <morsel/scene/outline.h>
#include <morsel/scene/rectangle.h>

#include <string>

namespace Morsel::Scene
{
  /// The shape of a particle body: a rectangle, or the bounding box of
  /// something else.
  struct BodyShape : Rectangle
  {
    std::string kind = "rectangle"; ///< rectangle|polygon|annulus|mesh

    std::string loops;      ///< of the polygon
    std::string side_names; ///< of its edges
    std::string mesh_file;

    dealii::Point<2> centre;                    ///< of the annulus [m]
    double           inner_radius   = 0.;       ///< [m], 0: a disc
    double           outer_radius   = 0.;       ///< [m]
    std::string      sector         = "0, 360"; ///< [degrees]
    unsigned int     edges_per_turn = 0;        ///< 0: half a spacing long

    void
    declare(dealii::ParameterHandler &prm);

    bool
    is_rectangle() const
    {
      return kind == "rectangle";
    }

    /// Makes the outline of what is no rectangle, and its bounding box.
    /// @param particles_across to which the edges of arcs are fitted
    /// @param folder of the scene's file, where the mesh is looked for
    /// @throws InputError, one clause
    void
    complete(unsigned int particles_across, const std::string &folder);

    /// The boundary. @pre complete() if it is no rectangle
    Outline
    outline() const;

    /// [m^2]
    double
    area() const
    {
      return is_rectangle() ? extent(0) * extent(1) : boundary.area();
    }

    /// The entry that says most of the shape, in its section.
    std::string
    main_entry() const;

  private:
    Outline boundary;
  };
} // namespace Morsel::Scene

#endif
