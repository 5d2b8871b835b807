#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/plate_mesh.h>

#include <deal.II/grid/grid_generator.h>

namespace Morsel::FE
{
  using namespace dealii;

  void
  make_plate(Triangulation<2>   &triangulation,
             const Point<2>     &lower_corner,
             const Point<2>     &upper_corner,
             const unsigned int  nx,
             const unsigned int  ny,
             const Tensor<1, 2> &shift)
  {
    std::vector<std::vector<double>> steps;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const unsigned int n = d == 0 ? nx : ny;
        steps.emplace_back(n, (upper_corner[d] - lower_corner[d]) / n);
        const double h = steps[d][0];
        if (n > 1)
          {
            steps[d].front() += shift[d] * h;
            steps[d].back() -= shift[d] * h;
          }
      }
    GridGenerator::subdivided_hyper_rectangle(
        triangulation, steps, lower_corner, upper_corner, true);
  }


  void
  refine_towards(Triangulation<2>  &triangulation,
                 const Point<2>    &point,
                 const unsigned int n_levels,
                 const double       layers)
  {
    for (unsigned int level = 0; level < n_levels; ++level)
      {
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned() &&
              distance_to_polygon(point, make_map(cell).polygon()) <=
                  layers * cell->diameter())
            cell->set_refine_flag();
        triangulation.execute_coarsening_and_refinement();
      }
  }
} // namespace Morsel::FE
