#include <morsel/core/errors.h>
#include <morsel/core/sentences.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/gmsh.h>
#include <morsel/scene/mesh.h>
#include <morsel/scene/outline.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace Morsel::Scene
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// A face with the body on its left.
    struct Face
    {
      unsigned int first, second; ///< vertices
      unsigned int boundary_id;
    };


    /// The boundary faces by their first vertex.
    std::map<unsigned int, Face>
    boundary_faces(const dealii::Triangulation<2> &mesh,
                   const std::string              &file)
    {
      std::map<unsigned int, Face> faces;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary())
              continue;
            Face               result{face->vertex_index(0),
                        face->vertex_index(1),
                        face->boundary_id()};
            const Tensor<1, 2> along  = face->vertex(1) - face->vertex(0);
            const Tensor<1, 2> inside = cell->center() - face->vertex(0);
            if (along[0] * inside[1] - along[1] * inside[0] < 0.)
              std::swap(result.first, result.second);
            if (!faces.emplace(result.first, result).second)
              {
                const Point<2> &p = mesh.get_vertices()[result.first];
                throw InputError("the boundary of the mesh '" + file +
                                 "' touches itself at (" + number_text(p[0]) +
                                 ", " + number_text(p[1]) + ") m.");
              }
          }
      return faces;
    }


    bool
    in_line(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      const Tensor<1, 2> d = b - a, e = c - b;
      return std::abs(d[0] * e[1] - d[1] * e[0]) < 1e-9 * d.norm() * e.norm();
    }


    /// Leaves out corners between edges of one side that are in line.
    Outline::Loop
    joined(const Outline::Loop &loop)
    {
      Outline::Loop      result;
      const unsigned int n = loop.corners.size();
      for (unsigned int k = 0; k < n; ++k)
        {
          const unsigned int before = (k + n - 1) % n;
          if (loop.sides[before] == loop.sides[k] &&
              in_line(loop.corners[before],
                      loop.corners[k],
                      loop.corners[(k + 1) % n]))
            continue;
          result.corners.push_back(loop.corners[k]);
          result.sides.push_back(loop.sides[k]);
        }
      return result;
    }


    /// Names that a Gmsh file gives to its physical lines.
    std::map<unsigned int, std::string>
    physical_names(const std::string &file)
    {
      std::map<unsigned int, std::string> names;
      std::ifstream                       stream(file);
      std::string                         line;
      while (std::getline(stream, line) && line.rfind("$PhysicalNames", 0) != 0)
        ;
      unsigned int n = 0;
      if (std::getline(stream, line))
        std::istringstream(line) >> n;
      for (unsigned int k = 0; k < n && std::getline(stream, line); ++k)
        {
          std::istringstream text(line);
          unsigned int       dimension = 0, tag = 0;
          text >> dimension >> tag;
          const auto begin = line.find('"'), end = line.rfind('"');
          if (dimension == 1 && begin < end)
            names[tag] = line.substr(begin + 1, end - begin - 1);
        }
      return names;
    }
    std::string
    side_name(const std::map<unsigned int, std::string> &known,
              const unsigned int                         id)
    {
      const auto name = known.find(id);
      return name == known.end() || name->second.empty()
                 ? "boundary " + std::to_string(id)
                 : name->second;
    }
  } // namespace


  void
  read_mesh(const std::string &file, dealii::Triangulation<2> &mesh)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      throw InputError("there is no file '" + file + "'." +
                       did_you_mean(file, files_beside(file)));
    GmshMesh data = read_gmsh(file);
    try
      {
        // deal.II orders quadrilaterals alone.
        if (std::all_of(
                data.cells.begin(), data.cells.end(), [](const auto &cell) {
                  return cell.vertices.size() == 4;
                }))
          {
            dealii::GridTools::delete_unused_vertices(
                data.vertices, data.cells, data.lines);
            dealii::GridTools::consistently_order_cells(data.cells);
          }
        mesh.create_triangulation(data.vertices, data.cells, data.lines);
      }
    catch (const std::exception &)
      {
        // deal.II's own words are kept from the terminal.
        throw InputError("'" + file +
                         "' is no mesh of the plane: its cells do not fit "
                         "together, or a line is no side of a cell at the "
                         "boundary; give triangles or quadrilaterals.");
      }
  }


  std::map<std::string, unsigned int>
  sides_of_mesh(const std::string &file)
  {
    dealii::Triangulation<2> mesh;
    read_mesh(file, mesh);
    const auto                          known = physical_names(file);
    std::map<std::string, unsigned int> sides;
    for (const auto &[vertex, face] : boundary_faces(mesh, file))
      sides[side_name(known, face.boundary_id)] = face.boundary_id;
    return sides;
  }


  Outline
  outline_of_mesh(const std::string &file)
  {
    dealii::Triangulation<2> mesh;
    read_mesh(file, mesh);
    return outline_of(mesh, file);
  }


  Outline
  outline_of(const dealii::Triangulation<2> &mesh, const std::string &file)
  {
    std::map<unsigned int, Face> faces = boundary_faces(mesh, file);

    const auto                           known = physical_names(file);
    std::map<unsigned int, unsigned int> side_of_id;
    std::vector<std::string>             names;
    for (const auto &[vertex, face] : faces)
      if (side_of_id.emplace(face.boundary_id, side_of_id.size()).second)
        names.push_back(side_name(known, face.boundary_id));

    std::vector<Outline::Loop> loops;
    while (!faces.empty())
      {
        Outline::Loop loop;
        for (auto face = faces.begin(); face != faces.end();)
          {
            loop.corners.push_back(mesh.get_vertices()[face->second.first]);
            loop.sides.push_back(side_of_id[face->second.boundary_id]);
            const unsigned int next = face->second.second;
            faces.erase(face);
            face = faces.find(next);
          }
        loops.push_back(joined(loop));
      }
    try
      {
        return Outline(loops, names);
      }
    catch (const InputError &error)
      {
        throw InputError("the boundary of the mesh '" + file +
                         "': " + as_sentence(error.what()));
      }
  }
} // namespace Morsel::Scene
