#include <morsel/core/vtu.h>
#include <morsel/fe/cell_functions.h>
#include <morsel/fe/open_crack_output.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
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


    double
    von_mises(const SymmetricTensor<2, 2> &s, const double zz)
    {
      return std::sqrt(0.5 * (std::pow(s[0][0] - s[1][1], 2) +
                              std::pow(s[1][1] - zz, 2) +
                              std::pow(zz - s[0][0], 2)) +
                       3. * s[0][1] * s[0][1]);
    }


    /// Parts per direction of one cell's picture: finer where the stress
    /// grows like 1/sqrt(r), that is within a tip's rings.
    unsigned int
    divisions_of(const QuadMap                         &map,
                 const unsigned int                     elsewhere,
                 const std::vector<TipResult>          &results,
                 const std::vector<Fracture::CrackTip> &tips)
    {
      constexpr double parts_per_ring = 12.;
      double           divisions      = elsewhere;
      for (const TipResult &r : results)
        {
          const double reach = r.rings.back().outer_radius;
          const double distance =
              distance_to_polygon(tips[r.tip].position, map.polygon());
          if (distance < reach)
            divisions = std::max(divisions,
                                 std::ceil(map.diameter() / std::sqrt(2.) *
                                           parts_per_ring / reach));
        }
      return std::min(divisions, 24.);
    }


    /// One rank's picture while it grows.
    class OpenCrackGrid
    {
    public:
      OpenCrackGrid(const Fracture::ElasticPlane          &material,
                    const std::vector<TipResult>          &results,
                    const std::vector<Fracture::CrackTip> &tips)
          : material(material)
          , results(results)
          , tips(tips)
      {
        // No column may be missing from a rank without cells.
        for (const auto &[name, n] : point_columns)
          grid.point_field(name, n);
        for (const char *name : {"cell", "enrichment", "degree"})
          grid.cell_field(name, 1);
      }

      void
      add_piece(const Polygon                      &piece,
                const Fracture::DisplacementSample *samples,
                const unsigned int                  cell,
                const unsigned int                  enrichment,
                const unsigned int                  degree)
      {
        auto &displacement = grid.point_field("displacement", 3);
        auto &stress       = grid.point_field("stress_xx_yy_zz_xy", 4);
        auto &equivalent   = grid.point_field("von_mises_stress", 1);
        auto &distance     = grid.point_field("distance_over_ring", 1);
        for (unsigned int i = 0; i < piece.size(); ++i)
          {
            const auto   s  = material.stress(samples[i].gradient);
            const double zz = material.out_of_plane_stress(s);
            const auto  &u  = samples[i].value;
            grid.add_point(piece[i][0], piece[i][1]);
            displacement.insert(displacement.end(), {u[0], u[1], 0.});
            stress.insert(stress.end(), {s[0][0], s[1][1], zz, s[0][1]});
            equivalent.push_back(von_mises(s, zz));
            distance.push_back(in_units_of_ring(piece[i], results, tips));
          }
        grid.add_cell(VtuGrid::Shape::polygon, piece.size());
        grid.cell_field("cell", 1).push_back(cell);
        grid.cell_field("enrichment", 1).push_back(enrichment);
        grid.cell_field("degree", 1).push_back(degree);
      }

      std::string
      text() const
      {
        return grid.text();
      }

    private:
      static constexpr std::array<std::pair<const char *, unsigned int>, 4>
          point_columns = {{{"displacement", 3},
                            {"stress_xx_yy_zz_xy", 4},
                            {"von_mises_stress", 1},
                            {"distance_over_ring", 1}}};

      const Fracture::ElasticPlane          &material;
      const std::vector<TipResult>          &results;
      const std::vector<Fracture::CrackTip> &tips;
      VtuGrid                                grid;
    };


    /// 0 none, 1 jump, 2 tip functions, 3 both.
    unsigned int
    kind_of(const CellEnrichment &e)
    {
      const unsigned int mask = e.mask();
      return ((mask & 15u) != 0 ? 1 : 0) +
             (mask >> CellEnrichment::max_slots ? 2 : 0);
    }


    /// Marks the vertices of a cell on which an enrichment of one kind
    /// (LocalNumbering::kind in a range) really lives: some of its functions
    /// there are not dropped.
    std::array<bool, 4>
    active_vertices(const XFEMSpace                            &space,
                    const DoFHandler<2>::active_cell_iterator  &cell,
                    const std::vector<types::global_dof_index> &dofs,
                    const unsigned int                          first_kind,
                    const unsigned int                          last_kind)
    {
      const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
      const unsigned int    per_vertex  = cell->get_fe().n_dofs_per_vertex();
      const auto           &constraints = space.get_constraints();
      std::array<bool, 4>   active{};
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int i = v * per_vertex; i < (v + 1) * per_vertex; ++i)
          {
            if (n.kind[i] < first_kind || n.kind[i] > last_kind)
              continue;
            const auto *entries = constraints.get_constraint_entries(dofs[i]);
            if (!constraints.is_constrained(dofs[i]) ||
                (entries != nullptr && !entries->empty()))
              active[v] = true;
          }
      return active;
    }
  } // namespace


  std::string
  open_crack_vtu(const ElasticProblem           &problem,
                 const ElasticProblem::Solution &solution,
                 const std::vector<TipResult>   &tips,
                 const unsigned int              divisions)
  {
    const XFEMSpace &space = problem.get_space();
    OpenCrackGrid    grid(problem.get_material(), tips, space.get_tips());
    CellFunctions    functions(space);
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
        const unsigned int degree =
            space.get_numbering(cell->active_fe_index()).degree;
        const unsigned int k =
            divisions_of(map, divisions, tips, space.get_tips());
        // All pieces' corners are sampled together.
        std::vector<Polygon>  pieces;
        std::vector<Point<2>> corners, reference;
        for (unsigned int part = 0; part < k * k; ++part)
          {
            const double x = (part % k) / double(k), y = (part / k) / double(k);
            const double w       = 1. / k;
            const Polygon square = {map.to_physical(Point<2>(x, y)),
                                    map.to_physical(Point<2>(x + w, y)),
                                    map.to_physical(Point<2>(x + w, y + w)),
                                    map.to_physical(Point<2>(x, y + w))};
            if (!e.cut)
              pieces.push_back(square);
            else
              for (const Polygon &piece :
                   cut_into_pieces(square, space.get_cracks()))
                pieces.push_back(piece);
          }
        for (const Polygon &piece : pieces)
          for (const Point<2> &p : inside_corners(piece))
            {
              corners.push_back(p);
              reference.push_back(map.to_reference(p));
            }
        const auto samples =
            functions.sample(cell, map, coefficients, corners, reference);
        std::size_t first = 0;
        for (const Polygon &piece : pieces)
          {
            grid.add_piece(piece,
                           &samples[first],
                           cell->active_cell_index(),
                           kind_of(e),
                           degree);
            first += piece.size();
          }
      }
    return grid.text();
  }


  std::string
  enriched_nodes_vtu(const XFEMSpace &space)
  {
    struct Node
    {
      Point<2> position;
      double   ramp = 0.;
      bool     jump = false, tip = false;
    };
    constexpr unsigned int               max_slots = CellEnrichment::max_slots;
    std::map<unsigned int, Node>         nodes;
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const CellEnrichment &e =
            space.get_enrichment(cell->active_cell_index());
        if (!e.enriched())
          continue;
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        const auto jump = active_vertices(space, cell, dofs, 1, max_slots);
        const auto tip =
            active_vertices(space, cell, dofs, max_slots + 1, 2 * max_slots);
        for (const unsigned int v : cell->vertex_indices())
          {
            Node &node    = nodes[cell->vertex_index(v)];
            node.position = cell->vertex(v);
            node.jump     = node.jump || jump[v];
            for (unsigned int s = 0; s < max_slots; ++s)
              if (e.tip[s] != CellEnrichment::none && tip[v])
                {
                  node.ramp = std::max(node.ramp, e.ramp[s][v]);
                  node.tip  = true;
                }
          }
      }
    VtuGrid grid;
    auto    append = [&](const char *name, const double value) {
      grid.point_field(name, 1).push_back(value);
    };
    for (const char *name : {"kind", "ramp"})
      grid.point_field(name, 1);
    for (const auto &[index, node] : nodes)
      if (node.jump || node.tip)
        {
          grid.add_point(node.position[0], node.position[1]);
          grid.add_cell(VtuGrid::Shape::vertex, 1);
          append("kind", (node.jump ? 1 : 0) + (node.tip ? 2 : 0));
          append("ramp", node.ramp);
        }
    return grid.text();
  }
} // namespace Morsel::FE
