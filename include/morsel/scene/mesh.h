#ifndef morsel_scene_mesh_h
#define morsel_scene_mesh_h

#include <morsel/scene/outline.h>

#include <deal.II/grid/tria.h>

#include <map>
#include <string>

namespace Morsel::Scene
{
  /// Reads a mesh of the plane.
  /// @param file a .msh of Gmsh, see read_gmsh()
  /// @throws InputError, one sentence, if it is none
  void
  read_mesh(const std::string &file, dealii::Triangulation<2> &mesh);


  /// The boundary ids of a mesh by the names of its sides: those of Gmsh's
  /// physical lines, else 'boundary 1'.
  /// @throws InputError as above
  std::map<std::string, unsigned int>
  sides_of_mesh(const std::string &file);


  /// The outline of a mesh wherever it has been moved to, see
  /// outline_of_mesh().
  /// @param file it was read from, for the names of its sides
  Outline
  outline_of(const dealii::Triangulation<2> &mesh, const std::string &file);
} // namespace Morsel::Scene

#endif
