#include <morsel/sph/neighbours.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  void
  CellGrid::build(const std::vector<dealii::Point<2>> &points,
                  const double                         radius)
  {
    dealii::Point<2> upper;
    origin = upper = points.empty() ? dealii::Point<2>() : points[0];
    for (const auto &x : points)
      for (unsigned int d = 0; d < 2; ++d)
        {
          origin[d] = std::min(origin[d], x[d]);
          upper[d]  = std::max(upper[d], x[d]);
        }

    // A few far fragments must not make the grid large: widen the cells
    // until there are at most a few per point.
    double       size   = radius;
    const double budget = 4. * points.size() + 64.;
    while (((upper[0] - origin[0]) / size + 1.) *
               ((upper[1] - origin[1]) / size + 1.) >
           budget)
      size *= 1.5;
    inverse_size = 1. / size;
    nx           = 1 + static_cast<long>((upper[0] - origin[0]) * inverse_size);
    ny           = 1 + static_cast<long>((upper[1] - origin[1]) * inverse_size);

    // Counting sort, stable: rows keep the points' order.
    cell_start.assign(nx * ny + 1, 0);
    cell_of.resize(points.size());
    order.resize(points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        cell_of[i] = cell(points[i][1] - origin[1]) * nx +
                     cell(points[i][0] - origin[0]);
        ++cell_start[cell_of[i] + 1];
      }
    for (long c = 0; c < nx * ny; ++c)
      cell_start[c + 1] += cell_start[c];
    std::vector<unsigned int> next(cell_start.begin(), cell_start.end() - 1);
    for (unsigned int i = 0; i < points.size(); ++i)
      order[next[cell_of[i]]++] = i;
  }


  long
  CellGrid::cell(const double offset) const
  {
    return static_cast<long>(std::floor(offset * inverse_size));
  }


  NeighbourList
  find_neighbours(const std::vector<dealii::Point<2>> &points,
                  const unsigned int                   n_rows,
                  const double                         radius)
  {
    CellGrid grid;
    grid.build(points, radius);

    NeighbourList list;
    list.start.reserve(n_rows + 1);
    list.index.reserve(24 * n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        grid.for_each_near(points[i], [&](const unsigned int j) {
          if (j != i && (points[j] - points[i]).norm_square() < radius * radius)
            list.index.push_back(j);
        });
        std::sort(list.index.begin() + list.start.back(), list.index.end());
        list.start.push_back(list.index.size());
      }
    return list;
  }
} // namespace Morsel::SPH
