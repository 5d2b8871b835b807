#include <morsel/fe/cell_functions.h>
#include <morsel/fe/point_values.h>

#include <algorithm>
#include <numeric>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    /// Points this far outside a cell, in its own coordinates, count as in.
    constexpr double on_the_edge = 1e-9;


    /// The points that lie in one cell, and where.
    struct PointsOfCell
    {
      std::vector<unsigned int> numbers;
      std::vector<Point<2>>     points, reference;
    };


    /// @param by_x numbers of the points in the order of their x
    PointsOfCell
    points_of(const QuadMap                   &map,
              const std::vector<Point<2>>     &points,
              const std::vector<unsigned int> &by_x)
    {
      Point<2> low = map.get_vertices()[0], high = low;
      for (const Point<2> &v : map.get_vertices())
        for (unsigned int d = 0; d < 2; ++d)
          {
            low[d]  = std::min(low[d], v[d]);
            high[d] = std::max(high[d], v[d]);
          }
      const double margin = on_the_edge * map.diameter();
      PointsOfCell result;
      for (auto n = std::lower_bound(by_x.begin(),
                                     by_x.end(),
                                     low[0] - margin,
                                     [&](const unsigned int i, const double x) {
                                       return points[i][0] < x;
                                     });
           n != by_x.end() && points[*n][0] <= high[0] + margin;
           ++n)
        {
          const Point<2> &p = points[*n];
          if (p[1] < low[1] - margin || p[1] > high[1] + margin)
            continue;
          const Point<2> r = map.to_reference(p);
          if (std::min(r[0], r[1]) < -on_the_edge ||
              std::max(r[0], r[1]) > 1. + on_the_edge)
            continue;
          result.numbers.push_back(*n);
          result.points.push_back(p);
          result.reference.push_back(r);
        }
      return result;
    }
  } // namespace


  std::vector<Fracture::DisplacementSample>
  sample_points(const ElasticProblem           &problem,
                const ElasticProblem::Solution &solution,
                const std::vector<Point<2>>    &points)
  {
    const XFEMSpace          &space = problem.get_space();
    std::vector<unsigned int> by_x(points.size());
    std::iota(by_x.begin(), by_x.end(), 0);
    std::sort(by_x.begin(), by_x.end(), [&](const auto a, const auto b) {
      return points[a][0] < points[b][0];
    });

    // By point: number of cells, displacement, gradient.
    constexpr unsigned int               width = 7;
    std::vector<double>                  sums(width * points.size(), 0.);
    CellFunctions                        functions(space);
    std::vector<types::global_dof_index> dofs;
    std::vector<double>                  local;
    for (const auto &cell : space.get_dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const QuadMap      map  = make_map(cell);
        const PointsOfCell here = points_of(map, points, by_x);
        if (here.numbers.empty())
          continue;
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        local.clear();
        cell->get_dof_indices(dofs);
        for (const types::global_dof_index d : dofs)
          local.push_back(solution(d));
        const auto samples =
            functions.sample(cell,
                             map,
                             functions.coefficients(cell, local),
                             here.points,
                             here.reference);
        for (unsigned int i = 0; i < samples.size(); ++i)
          {
            double *sum = &sums[width * here.numbers[i]];
            sum[0] += 1.;
            for (unsigned int c = 0; c < 2; ++c)
              {
                sum[1 + c] += samples[i].value[c];
                for (unsigned int d = 0; d < 2; ++d)
                  sum[3 + 2 * c + d] += samples[i].gradient[c][d];
              }
          }
      }
    if (!sums.empty())
      Utilities::MPI::sum(sums, solution.get_mpi_communicator(), sums);

    std::vector<Fracture::DisplacementSample> result(points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const double *sum = &sums[width * i];
        Assert(sum[0] > 0., ExcMessage("A point lies outside the body."));
        for (unsigned int c = 0; c < 2; ++c)
          {
            result[i].value[c] = sum[1 + c] / sum[0];
            for (unsigned int d = 0; d < 2; ++d)
              result[i].gradient[c][d] = sum[3 + 2 * c + d] / sum[0];
          }
      }
    return result;
  }
} // namespace Morsel::FE
