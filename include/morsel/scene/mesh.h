#ifndef morsel_scene_mesh_h
#define morsel_scene_mesh_h

#include <deal.II/grid/tria.h>

#include <map>
#include <string>

namespace Morsel::Scene
{
  /// Reads a mesh of the plane.
  /// @param file in any format that deal.II reads by its ending
  /// @throws InputError, one sentence, if it is none
  void
  read_mesh(const std::string &file, dealii::Triangulation<2> &mesh);


  /// The boundary ids of a mesh by the names of its sides: those of Gmsh's
  /// physical lines, else 'boundary 1'.
  /// @throws InputError as above
  std::map<std::string, unsigned int>
  sides_of_mesh(const std::string &file);
} // namespace Morsel::Scene

#endif
