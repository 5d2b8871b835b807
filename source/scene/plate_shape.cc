#include <morsel/scene/mesh.h>
#include <morsel/scene/plate_shape.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

namespace Morsel::Scene
{
  namespace
  {
    /// Cosine and sine of an angle in degrees, exact at right angles.
    std::array<double, 2>
    direction_of(const double degrees)
    {
      const double quarters = degrees / 90.;
      if (quarters == std::round(quarters))
        {
          const int quarter =
              static_cast<int>(quarters - 4. * std::floor(0.25 * quarters));
          return {{quarter == 0   ? 1.
                   : quarter == 2 ? -1.
                                  : 0.,
                   quarter == 1   ? 1.
                   : quarter == 3 ? -1.
                                  : 0.}};
        }
      const double angle = degrees * dealii::numbers::PI / 180.;
      return {{std::cos(angle), std::sin(angle)}};
    }
  } // namespace


  void
  PlateShape::declare(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    Rectangle::declare(prm);
    prm.add_parameter(
        "Mesh file",
        mesh_file,
        "Mesh of the body, a .msh of Gmsh (text), relative to the scene's "
        "file: its boundary takes the place of the rectangle's. Triangles or "
        "quadrilaterals for a rigid body, quadrilaterals for an elastic one. "
        "The rectangle between the corners if empty.",
        Patterns::Anything());
    prm.add_parameter("Mesh angle",
                      mesh_angle,
                      "By how much the mesh is turned about its origin, "
                      "anticlockwise, before it is shifted [degrees].",
                      Patterns::Double(-360., 360.));
    prm.add_parameter("Mesh shift",
                      mesh_shift,
                      "Where the mesh's origin comes to lie, 'x, y' [m].");
  }


  void
  PlateShape::complete(const std::string &folder)
  {
    if (!is_mesh())
      return;
    // So that used.prm, which lies elsewhere, finds it, too.
    mesh_file =
        std::filesystem::absolute(std::filesystem::path(folder) / mesh_file)
            .lexically_normal()
            .string();
    dealii::Triangulation<2> mesh;
    place_mesh(mesh);
    boundary     = outline_of(mesh, mesh_file);
    lower_corner = boundary.lower();
    upper_corner = boundary.upper();
    corners.clear();
    for (const auto &cell : mesh.active_cell_iterators())
      for (unsigned int v = 0; v < 4; ++v)
        corners.push_back(cell->vertex(std::min(v, cell->n_vertices() - 1)));
  }


  Outline
  PlateShape::outline() const
  {
    return is_mesh() ? boundary
                     : Outline::rectangle(lower_corner, upper_corner);
  }


  std::vector<dealii::Point<2>>
  PlateShape::cell_corners() const
  {
    if (is_mesh())
      return corners;
    return {lower_corner,
            {upper_corner[0], lower_corner[1]},
            {lower_corner[0], upper_corner[1]},
            upper_corner};
  }


  Rectangle
  PlateShape::box_before(const unsigned int axis, const Rectangle &food) const
  {
    if (!is_mesh())
      return *this;
    const unsigned int across = 1 - axis;
    const double       begin  = food.lower_corner[across],
                 end          = food.upper_corner[across];
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double           lower = infinity, upper = -infinity;
    for (const Outline::Edge &edge : boundary.get_edges())
      {
        // From where to where the edge is within the strip, in its own length.
        double       from = 0., to = 1.;
        const double start = edge.first[across],
                     way   = edge.second[across] - start;
        if (way == 0. && (start < begin || start > end))
          continue;
        if (way != 0.)
          {
            const double a = (begin - start) / way, b = (end - start) / way;
            from = std::max(from, std::min(a, b));
            to   = std::min(to, std::max(a, b));
          }
        for (const double t : {from, to})
          if (from <= to)
            {
              const double x =
                  edge.first[axis] + t * (edge.second[axis] - edge.first[axis]);
              lower = std::min(lower, x);
              upper = std::max(upper, x);
            }
      }
    if (lower > upper)
      return *this;
    Rectangle part            = *this;
    part.lower_corner[axis]   = lower;
    part.upper_corner[axis]   = upper;
    part.lower_corner[across] = std::max(lower_corner[across], begin);
    part.upper_corner[across] = std::min(upper_corner[across], end);
    return part;
  }


  void
  PlateShape::place_mesh(dealii::Triangulation<2> &mesh) const
  {
    read_mesh(mesh_file, mesh);
    const auto along = direction_of(mesh_angle);
    dealii::GridTools::transform(
        [this, along](const dealii::Point<2> &p) {
          return dealii::Point<2>(
              along[0] * p[0] - along[1] * p[1] + mesh_shift[0],
              along[1] * p[0] + along[0] * p[1] + mesh_shift[1]);
        },
        mesh);
  }
} // namespace Morsel::Scene
