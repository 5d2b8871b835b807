#ifndef morsel_scene_plate_shape_h
#define morsel_scene_plate_shape_h

#include <morsel/scene/outline.h>
#include <morsel/scene/rectangle.h>

#include <deal.II/grid/tria.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// The shape of a plate or tooth: a rectangle, or the bounding box of a mesh
  /// that was turned about its origin and then shifted to its place.
  struct PlateShape : Rectangle
  {
    std::string      mesh_file;       ///< empty: the rectangle
    dealii::Point<2> mesh_shift;      ///< [m]
    double           mesh_angle = 0.; ///< [degrees], anticlockwise

    void
    declare(dealii::ParameterHandler &prm);

    bool
    is_mesh() const
    {
      return !mesh_file.empty();
    }

    /// Makes the path of a mesh absolute, and its outline and box.
    /// @param folder of the scene's file, where the mesh is looked for
    /// @throws InputError, one clause
    void
    complete(const std::string &folder);

    /// The boundary at time 0. @pre complete() if it is a mesh
    Outline
    outline() const;

    /// Reads the mesh and puts it in its place.
    /// @pre is_mesh()
    void
    place_mesh(dealii::Triangulation<2> &mesh) const;

    /// Corners of the cells at time 0, four each in deal.II's order, the last
    /// one of a triangle twice [m]. A rectangle is one cell.
    /// @pre complete() if it is a mesh
    std::vector<dealii::Point<2>>
    cell_corners() const;

    /// The box of the part that lies between two coordinates across an axis:
    /// what stands before food of that width; the whole box if nothing does.
    Rectangle
    box_before(unsigned int axis, const Rectangle &food) const;

  private:
    Outline                       boundary;
    std::vector<dealii::Point<2>> corners; ///< of a mesh's cells
  };
} // namespace Morsel::Scene

#endif
