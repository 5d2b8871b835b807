#include <morsel/fe/cell_functions.h>
#include <morsel/fe/open_crack_output.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Columns of a vtu file, filled cell by cell.
    struct Columns
    {
      std::ostringstream points, displacement, stress, von_mises, ring;
      std::ostringstream connectivity, offsets, types, enrichment, degree;
      unsigned int       n_points = 0, n_cells = 0;

      Columns()
      {
        for (auto *s : {&points, &displacement, &stress, &von_mises, &ring})
          s->precision(8);
      }
    };


    void
    write_array(std::ostream      &out,
                const char        *type,
                const char        *name,
                const unsigned int components,
                const std::string &data)
    {
      out << "<DataArray type=\"" << type << "\" Name=\"" << name
          << "\" NumberOfComponents=\"" << components
          << "\" format=\"ascii\">\n"
          << data << "</DataArray>\n";
    }


    std::string
    vtu_text(const Columns     &c,
             const std::string &point_data,
             const std::string &cell_data)
    {
      std::ostringstream out;
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
             "version=\"0.1\" byte_order=\"LittleEndian\">\n"
             "<UnstructuredGrid>\n<Piece NumberOfPoints=\""
          << c.n_points << "\" NumberOfCells=\"" << c.n_cells
          << "\">\n<Points>\n";
      write_array(out, "Float64", "points", 3, c.points.str());
      out << "</Points>\n<Cells>\n";
      write_array(out, "Int32", "connectivity", 1, c.connectivity.str());
      write_array(out, "Int32", "offsets", 1, c.offsets.str());
      write_array(out, "UInt8", "types", 1, c.types.str());
      out << "</Cells>\n<PointData>\n"
          << point_data << "</PointData>\n<CellData>\n"
          << cell_data
          << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
      return out.str();
    }


    /// Corners moved towards the centre by 1e-6, off the crack and the tip:
    /// the fields are taken there, on the piece's own side.
    std::vector<Point<2>>
    inside_corners(const Polygon &piece)
    {
      Tensor<1, 2> center;
      for (const Point<2> &p : piece)
        center += p / static_cast<double>(piece.size());
      std::vector<Point<2>> corners;
      for (const Point<2> &p : piece)
        corners.push_back(p + 1e-6 * (Point<2>(center) - p));
      return corners;
    }


    double
    in_units_of_ring(const Point<2>                        &p,
                     const std::vector<TipResult>          &results,
                     const std::vector<Fracture::CrackTip> &tips)
    {
      double smallest = 1e3;
      for (const TipResult &r : results)
        if (!r.rings.empty())
          smallest = std::min(smallest,
                              p.distance(tips[r.tip].position) /
                                  r.rings.back().outer_radius);
      return smallest;
    }
  } // namespace


  std::string
  open_crack_vtu(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 const std::vector<TipResult>   &tips,
                 const unsigned int              divisions)
  {
    const XFEMSpace                     &space    = problem.get_space();
    const Fracture::ElasticPlane        &material = problem.get_material();
    Columns                              c;
    CellFunctions                        functions(space);
    std::vector<types::global_dof_index> dofs;
    std::vector<double>                  local;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const QuadMap         map = make_map(cell);
        const CellEnrichment &e =
            space.get_enrichment(cell->active_cell_index());
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        local.clear();
        cell->get_dof_indices(dofs);
        for (const types::global_dof_index d : dofs)
          local.push_back(solution(d));
        const Eigen::MatrixX2d coefficients =
            functions.coefficients(cell, local);
        const unsigned int k = divisions;
        for (unsigned int part = 0; part < k * k; ++part)
          {
            const double x = (part % k) / double(k), y = (part / k) / double(k);
            const double w       = 1. / k;
            const Polygon square = {map.to_physical(Point<2>(x, y)),
                                    map.to_physical(Point<2>(x + w, y)),
                                    map.to_physical(Point<2>(x + w, y + w)),
                                    map.to_physical(Point<2>(x, y + w))};
            const auto    pieces =
                e.cut ? cut_into_pieces(square, space.get_cracks())
                         : std::vector<Polygon>(1, square);
            for (const Polygon &piece : pieces)
              {
                const auto            corners = inside_corners(piece);
                std::vector<Point<2>> reference;
                for (const Point<2> &p : corners)
                  reference.push_back(map.to_reference(p));
                const auto samples = functions.sample(
                    cell, map, coefficients, corners, reference);
                for (unsigned int i = 0; i < piece.size(); ++i)
                  {
                    const auto   s  = material.stress(samples[i].gradient);
                    const double zz = material.out_of_plane_stress(s);
                    const double von_mises =
                        std::sqrt(0.5 * (std::pow(s[0][0] - s[1][1], 2) +
                                         std::pow(s[1][1] - zz, 2) +
                                         std::pow(zz - s[0][0], 2)) +
                                  3. * s[0][1] * s[0][1]);
                    c.points << piece[i] << " 0\n";
                    c.displacement << samples[i].value << " 0\n";
                    c.stress << s[0][0] << ' ' << s[1][1] << ' ' << zz << ' '
                             << s[0][1] << '\n';
                    c.von_mises << von_mises << '\n';
                    c.ring << in_units_of_ring(piece[i], tips, space.get_tips())
                           << '\n';
                    c.connectivity << c.n_points++ << ' ';
                  }
                c.connectivity << '\n';
                c.offsets << c.n_points << '\n';
                c.types << "7\n";
                const unsigned int mask = e.mask();
                c.enrichment << ((mask & 15u) != 0 ? 1 : 0) +
                                    (mask >> CellEnrichment::max_slots ? 2 : 0)
                             << '\n';
                c.degree << space.get_numbering(cell->active_fe_index()).degree
                         << '\n';
                ++c.n_cells;
              }
          }
      }
    std::ostringstream point_data, cell_data;
    write_array(point_data, "Float64", "displacement", 3, c.displacement.str());
    write_array(point_data, "Float64", "stress_xx_yy_zz_xy", 4, c.stress.str());
    write_array(
        point_data, "Float64", "von_mises_stress", 1, c.von_mises.str());
    write_array(point_data, "Float64", "distance_over_ring", 1, c.ring.str());
    write_array(cell_data, "Int32", "enrichment", 1, c.enrichment.str());
    write_array(cell_data, "Int32", "degree", 1, c.degree.str());
    return vtu_text(c, point_data.str(), cell_data.str());
  }


  std::string
  enriched_nodes_vtu(const XFEMSpace &space)
  {
    struct Node
    {
      Point<2> position;
      double   ramp = 0.;
      int      jump = 0;
    };
    std::map<unsigned int, Node> nodes;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const CellEnrichment &e =
            space.get_enrichment(cell->active_cell_index());
        if (!e.enriched())
          continue;
        for (const unsigned int v : cell->vertex_indices())
          {
            Node &node    = nodes[cell->vertex_index(v)];
            node.position = cell->vertex(v);
            for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
              {
                if (e.tip[s] != CellEnrichment::none)
                  node.ramp = std::max(node.ramp, e.ramp[s][v]);
                if (e.jump_crack[s] != CellEnrichment::none)
                  node.jump = 1;
              }
          }
      }
    Columns            c;
    std::ostringstream ramp, jump;
    for (const auto &[index, node] : nodes)
      {
        c.points << node.position << " 0\n";
        c.connectivity << c.n_points++ << '\n';
        c.offsets << c.n_points << '\n';
        c.types << "1\n";
        ++c.n_cells;
        ramp << node.ramp << '\n';
        jump << node.jump << '\n';
      }
    std::ostringstream point_data;
    write_array(point_data, "Float64", "ramp", 1, ramp.str());
    write_array(point_data, "Int32", "jump", 1, jump.str());
    return vtu_text(c, point_data.str(), "");
  }
} // namespace Morsel::FE
