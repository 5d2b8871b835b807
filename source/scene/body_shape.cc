#include <morsel/core/errors.h>
#include <morsel/core/number_list.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/body_shape.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace Morsel::Scene
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Utilities::split_string_list;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    constexpr double degree = dealii::numbers::PI / 180.;


    /// The side of a name, which joins the names if it is new.
    unsigned int
    side_of(const std::string &name, std::vector<std::string> &names)
    {
      const auto known = std::find(names.begin(), names.end(), name);
      if (known != names.end())
        return known - names.begin();
      if (name.empty() || name == "box" || name == "everywhere")
        throw InputError("'" + name +
                         "' is no name for a side; conditions mean something "
                         "else by 'box' and 'everywhere'");
      names.push_back(name);
      return names.size() - 1;
    }


    Outline
    polygon(const std::string &text, const std::string &side_names)
    {
      std::vector<Outline::Loop> loops;
      unsigned int               n_edges = 0;
      for (const std::string &loop_text : split_string_list(text, ';'))
        {
          loops.emplace_back();
          for (const std::string &corner : split_string_list(loop_text, '>'))
            {
              const std::vector<double> x = number_list(corner, 2);
              if (x.empty())
                throw InputError("it has an empty corner; corners are given as "
                                 "'x, y > x, y > ...'");
              loops.back().corners.emplace_back(x[0], x[1]);
            }
          n_edges += loops.back().corners.size();
        }
      const std::vector<std::string> given = split_string_list(side_names, ',');
      if (!given.empty() && given.size() != n_edges)
        throw InputError("it has " + std::to_string(n_edges) +
                         " edges, but 'Side names' has " +
                         std::to_string(given.size()) +
                         " names; give one for every edge, in their order");
      std::vector<std::string> names;
      unsigned int             edge = 0;
      for (Outline::Loop &loop : loops)
        for (unsigned int k = 0; k < loop.corners.size(); ++k, ++edge)
          loop.sides.push_back(side_of(
              given.empty() ? "edge " + std::to_string(edge + 1) : given[edge],
              names));
      return Outline(loops, names);
    }


    /// Corners of an arc of @p n edges whose sectors have the area of the
    /// circle's.
    void
    add_arc(const BodyShape   &shape,
            const double       radius,
            const double       begin,
            const double       end,
            const unsigned int n,
            const unsigned int side,
            Outline::Loop     &loop)
    {
      const double turn  = std::abs(end - begin) / n;
      const double scale = std::sqrt(turn / std::sin(turn));
      const bool   whole =
          std::abs(std::abs(end - begin) - 2. * dealii::numbers::PI) < 1e-12;
      for (unsigned int k = 0; k < (whole ? n : n + 1); ++k)
        {
          const double angle = begin + (end - begin) * k / n;
          loop.corners.push_back(
              shape.centre +
              scale * radius *
                  Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
          loop.sides.push_back(side);
        }
    }


    /// @param edge_length of arcs, at most [m]
    Outline
    annulus(const BodyShape &shape, const double edge_length)
    {
      const std::vector<double> angles = number_list(shape.sector, 2);
      if (angles.empty() || !(angles[1] > angles[0]) ||
          angles[1] - angles[0] > 360.)
        throw InputError("its 'Sector' is '" + shape.sector +
                         "'; give the first and the last angle in degrees, "
                         "rising by at most 360, as in '0, 90'");
      if (shape.edges_per_turn > 0 && shape.edges_per_turn < 12)
        throw InputError("its 'Edges per turn' is " +
                         std::to_string(shape.edges_per_turn) +
                         "; give at least 12, or 0 for edges half a spacing "
                         "long");
      if (!(shape.outer_radius > shape.inner_radius))
        throw InputError("'Outer radius' " + number_text(shape.outer_radius) +
                         " m must exceed 'Inner radius' " +
                         number_text(shape.inner_radius) + " m");
      const double begin = degree * angles[0], end = degree * angles[1];
      const bool   whole = angles[1] - angles[0] == 360.;
      const auto   edges = [&](const double radius) {
        const double per_turn =
            shape.edges_per_turn > 0
                  ? shape.edges_per_turn
                  : std::max(24.,
                           2. * dealii::numbers::PI * radius / edge_length);
        return static_cast<unsigned int>(
            std::ceil(per_turn * (angles[1] - angles[0]) / 360. - 1e-9));
      };
      std::vector<Outline::Loop> loops(1);
      add_arc(shape,
              shape.outer_radius,
              begin,
              end,
              edges(shape.outer_radius),
              1,
              loops[0]);
      // A sector's arcs are one loop with the straight sides between them; the
      // edge behind the last corner of an arc belongs to these.
      if (!whole)
        loops[0].sides.back() = 3;
      else if (shape.inner_radius > 0.)
        loops.emplace_back();
      if (shape.inner_radius > 0.)
        add_arc(shape,
                shape.inner_radius,
                end,
                begin,
                edges(shape.inner_radius),
                0,
                loops.back());
      else if (!whole)
        {
          loops[0].corners.push_back(shape.centre);
          loops[0].sides.push_back(2);
        }
      if (!whole)
        loops[0].sides.back() = 2;
      return Outline(loops, {"inner", "outer", "first", "last"});
    }
  } // namespace


  void
  BodyShape::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Kind",
        kind,
        "'rectangle' between its corners; 'polygon' with any holes; 'annulus' "
        "(with an inner radius of 0 a disc) or a sector of it; the outline of "
        "a 'mesh'. Over time, sides are loaded and held on a rectangle's "
        "lattice only.",
        Patterns::Selection("rectangle|polygon|annulus|mesh"));
    Rectangle::declare(prm);
    prm.add_parameter("Loops",
                      loops,
                      "Of the polygon: corners 'x, y > x, y > x, y' of closed "
                      "loops [m]; further loops after ';' are holes. The "
                      "direction does not matter.");
    prm.add_parameter(
        "Side names",
        side_names,
        "Of the polygon: names of its edges in the order of 'Loops', separated "
        "by commas, the first one from the first corner to the second; edges "
        "may share a name. Else they are 'edge 1', 'edge 2' and so on.");
    prm.add_parameter("Centre", centre, "Of the annulus, 'x, y' [m].");
    prm.add_parameter("Inner radius",
                      inner_radius,
                      "Of the annulus [m]; the side is called 'inner'.",
                      Patterns::Double(0.));
    prm.add_parameter("Outer radius",
                      outer_radius,
                      "Of the annulus [m]; the side is called 'outer'.",
                      Patterns::Double(0.));
    prm.add_parameter(
        "Sector",
        sector,
        "Of the annulus: first and last angle [degrees], from x to y; its "
        "straight sides are called 'first' and 'last'.");
    prm.add_parameter(
        "Edges per turn",
        edges_per_turn,
        "Of the annulus: each circle is a polygon of so many edges and of the "
        "circle's area [1]; 0 makes edges half a particle spacing long.",
        Patterns::Integer(0, 100000));
    prm.add_parameter(
        "Mesh file",
        mesh_file,
        "Of the mesh: a file of triangles or quadrilaterals in x, y, as .msh "
        "of Gmsh, relative to the scene's; sides are called as its physical "
        "lines are, else 'boundary 1' by their numbers.");
  }


  void
  BodyShape::complete(const unsigned int particles_across,
                      const std::string &folder)
  {
    if (is_rectangle())
      return;
    if (kind == "polygon")
      boundary = polygon(loops, side_names);
    else if (kind == "mesh")
      {
        if (mesh_file.empty())
          throw InputError("the shape is a mesh, but no file is named");
        // So that used.prm, which lies elsewhere, finds it, too.
        mesh_file =
            std::filesystem::absolute(std::filesystem::path(folder) / mesh_file)
                .lexically_normal()
                .string();
        boundary = outline_of_mesh(mesh_file);
      }
    else
      {
        // The sector's extent along x gives the spacing.
        boundary            = annulus(*this, 0.01 * outer_radius);
        const double extent = boundary.upper()[0] - boundary.lower()[0];
        boundary =
            annulus(*this, 0.5 * extent / std::max(1u, particles_across));
      }
    lower_corner = boundary.lower();
    upper_corner = boundary.upper();
  }


  Outline
  BodyShape::outline() const
  {
    return is_rectangle() ? Outline::rectangle(lower_corner, upper_corner)
                          : boundary;
  }


  std::string
  BodyShape::main_entry() const
  {
    return kind == "polygon"   ? "Loops"
           : kind == "annulus" ? "Outer radius"
           : kind == "mesh"    ? "Mesh file"
                               : "Upper corner";
  }
} // namespace Morsel::Scene
