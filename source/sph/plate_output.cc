#include <morsel/core/vtu.h>
#include <morsel/sph/plate_output.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using dealii::Point;

  namespace
  {
    /// Appends a point with the fields of a sample there.
    void
    add_sample(VtuGrid                            &grid,
               const Point<2>                     &p,
               const Fracture::DisplacementSample &sample,
               const Fracture::ElasticPlane       &material)
    {
      const auto   s         = material.stress(sample.gradient);
      const double zz        = material.out_of_plane_stress(s);
      const double von_mises = std::sqrt(0.5 * (std::pow(s[0][0] - s[1][1], 2) +
                                                std::pow(s[1][1] - zz, 2) +
                                                std::pow(zz - s[0][0], 2)) +
                                         3. * s[0][1] * s[0][1]);
      grid.add_point(p[0], p[1]);
      const auto append = [&](const char                   *name,
                              std::initializer_list<double> values) {
        auto &field = grid.point_field(name, values.size());
        field.insert(field.end(), values);
      };
      append("displacement", {sample.value[0], sample.value[1], 0.});
      append("stress_xx_yy_zz_xy", {s[0][0], s[1][1], zz, s[0][1]});
      append("von_mises_stress", {von_mises});
    }


    double
    in_units_of_ring(const PlateProblem &problem, const Point<2> &p)
    {
      double smallest = 1e3;
      for (const Fracture::TipResult &r : problem.get_results().tips)
        smallest = std::min(smallest,
                            p.distance(problem.get_tips()[r.tip].position) /
                                r.rings.back().outer_radius);
      return smallest;
    }

    /// Each cell with points of its own.
    VtuGrid
    cells_grid(const Equilibrium &body)
    {
      VtuGrid      grid;
      const Cloud &cloud = body.get_cloud();
      for (unsigned int i = 0; i < cloud.size(); ++i)
        {
          const auto &facets = cloud.cells[i].facets;
          for (const CellFacet &facet : facets)
            add_sample(
                grid,
                facet.first,
                body.get_field().sample_from(cloud.points[i], facet.first),
                body.get_material());
          grid.add_cell(VtuGrid::Shape::polygon, facets.size());
          grid.cell_field("cell", 1).push_back(i);
          grid.cell_field("area", 1).push_back(cloud.cells[i].area);
        }
      return grid;
    }
  } // namespace


  std::string
  particles_vtu(const Equilibrium &body)
  {
    VtuGrid      grid;
    const Cloud &cloud = body.get_cloud();
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        add_sample(grid,
                   cloud.points[i],
                   {body.get_displacement()[i], body.get_gradients()[i]},
                   body.get_material());
        grid.point_field("volume", 1).push_back(cloud.cells[i].area);
        grid.add_cell(VtuGrid::Shape::vertex, 1);
      }
    return grid.text();
  }


  std::string
  cells_vtu(const Equilibrium &body)
  {
    return cells_grid(body).text();
  }


  std::string
  cells_vtu(const PlateProblem &problem)
  {
    VtuGrid              grid     = cells_grid(problem);
    std::vector<double> &distance = grid.point_field("distance_over_ring", 1);
    for (const VoronoiCell &cell : problem.get_cloud().cells)
      for (const CellFacet &facet : cell.facets)
        distance.push_back(in_units_of_ring(problem, facet.first));
    return grid.text();
  }
} // namespace Morsel::SPH
