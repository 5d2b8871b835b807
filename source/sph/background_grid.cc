#include <morsel/core/errors.h>
#include <morsel/sph/background_grid.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace Morsel::SPH
{
  using dealii::Point;


  template <int dim>
  BackgroundGrid<dim>
  BackgroundGrid<dim>::around(const Point<dim> &lower,
                              const Point<dim> &upper,
                              const double      support,
                              const double      spacing)
  {
    Assert(support > 0. && spacing > 0.,
           dealii::ExcMessage("Support and spacing must be above 0."));
    const double   half = 0.5 * spacing;
    BackgroundGrid grid;
    double         least = std::numeric_limits<double>::max();
    for (int d = 0; d < dim; ++d)
      {
        Assert(upper[d] > lower[d], dealii::ExcMessage("The box is empty."));
        least = std::min(least, upper[d] - lower[d] + half);
      }

    // Ranks get pieces of the curve through all cells. One coarse cell across
    // the narrow side, halved again and again, and an even number along the
    // others make their cuts straight, along lattice rows where there is a
    // choice: a cut of a square in two, or in four, is as short as can be.
    while (half * std::ceil(support / half) * (2u << grid.n_levels) <= least)
      ++grid.n_levels;
    const unsigned int children = 1u << grid.n_levels;
    grid.cell_size =
        half * std::ceil(std::max(support, least / children) / half);

    for (int d = 0; d < dim; ++d)
      {
        const unsigned int n_coarse = std::ceil((upper[d] - lower[d] + half) /
                                                (grid.cell_size * children));
        grid.n[d] = (n_coarse > 1 ? (n_coarse + 1) / 2 * 2 : 1) * children;
        // The box in the middle, but for a multiple of half a spacing.
        const double spare = grid.n[d] * grid.cell_size - (upper[d] - lower[d]);
        grid.origin[d] =
            lower[d] - half * (std::floor(0.5 * spare / half - 0.5) + 0.5);
      }
    return grid;
  }


  template <int dim>
  unsigned int
  BackgroundGrid<dim>::n_cells() const
  {
    unsigned int product = 1;
    for (const unsigned int along : n)
      product *= along;
    return product;
  }


  template <int dim>
  unsigned int
  BackgroundGrid<dim>::cell_of(const Point<dim> &x) const
  {
    unsigned int cell = 0;
    for (int d = dim - 1; d >= 0; --d)
      {
        const double along = std::floor((x[d] - origin[d]) / cell_size);
        if (!(along >= 0. && along < n[d]))
          {
            std::ostringstream message;
            message << "A particle at (" << x
                    << ") m lies outside of the box of its body, which begins "
                       "at ("
                    << origin << ") m.";
            throw InputError(message.str());
          }
        cell = cell * n[d] + static_cast<unsigned int>(along);
      }
    return cell;
  }


  Bins::Bins(const std::vector<unsigned int> &cell_of,
             const unsigned int               n_cells)
      : start(n_cells + 1, 0)
      , order(cell_of.size())
  {
    for (const unsigned int cell : cell_of)
      ++start[cell + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());

    std::vector<unsigned int> next(start.begin(), start.end() - 1);
    for (unsigned int i = 0; i < cell_of.size(); ++i)
      order[next[cell_of[i]]++] = i;
  }


  template struct BackgroundGrid<2>;
} // namespace Morsel::SPH
