#ifndef morsel_scene_gmsh_h
#define morsel_scene_gmsh_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// A mesh of the plane as it stands in a file of Gmsh.
  struct GmshMesh
  {
    std::vector<dealii::Point<2>> vertices; ///< [m]
    /// Triangles and quadrilaterals, turned to the left.
    std::vector<dealii::CellData<2>> cells;
    dealii::SubCellData              lines; ///< with their physical groups
  };


  /// Reads Gmsh's text format, version 1, 2 or 4 (Gmsh's manual, "MSH file
  /// format"). deal.II's reader trusts the file: it loops for ever where a
  /// section is left open, and takes numbers of nodes that there are not.
  /// Checked here: every word, that cells have corners that exist, differ, and
  /// go round a convex area, and that no cells overlap at a face.
  /// @param file an ordinary file that exists
  /// @throws InputError, one sentence with the line of the file
  GmshMesh
  read_gmsh(const std::string &file);
} // namespace Morsel::Scene

#endif
