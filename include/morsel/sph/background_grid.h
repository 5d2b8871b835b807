#ifndef morsel_sph_background_grid_h
#define morsel_sph_background_grid_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Morsel::SPH
{
  /// A regular grid of square (cubic) cells; knows cells by integers, so that
  /// every point has exactly one, on faces too, on every rank alike.
  template <int dim>
  struct BackgroundGrid
  {
    dealii::Point<dim>            origin;
    double                        cell_size = 0.; ///< [m]
    std::array<unsigned int, dim> n{};            ///< cells per direction
    unsigned int n_levels = 0; ///< how often every n can be halved

    /// A grid that covers a box and at least a quarter of @p spacing around
    /// it, as many cells across its narrow side as the largest power of two
    /// for which they are not below @p support. They are a multiple of half of
    /// the spacing and stand a quarter of it off the box's edges: no particle
    /// of a lattice in the box lies on a face.
    static BackgroundGrid
    around(const dealii::Point<dim> &lower,
           const dealii::Point<dim> &upper,
           double                    support,
           double                    spacing);

    unsigned int
    n_cells() const;

    /// The number of the cell that holds @p x, along x fastest.
    /// @throws InputError if @p x lies outside of the grid.
    unsigned int
    cell_of(const dealii::Point<dim> &x) const;
  };


  /// Numbers sorted by the cell they belong to: those of cell c stand at
  /// [start[c], start[c+1]) of order. Keeps their order within a cell.
  struct Bins
  {
    std::vector<unsigned int> start, order;

    Bins(const std::vector<unsigned int> &cell_of, unsigned int n_cells);
  };


  /// Calls f(first, last) for the runs of cells along x that make up
  /// @p centre and the cells around it.
  template <int dim, typename Function>
  void
  for_each_run_around(const BackgroundGrid<dim> &grid,
                      const unsigned int         centre,
                      const Function            &f)
  {
    unsigned int n_rows = 1;
    for (int d = 1; d < dim; ++d)
      n_rows *= 3;
    for (unsigned int row = 0; row < n_rows; ++row)
      {
        unsigned int rest = centre / grid.n[0], stride = grid.n[0];
        unsigned int digits = row, first_of_row = 0;
        bool         inside = true;
        for (int d = 1; d < dim; ++d)
          {
            const int along = int(rest % grid.n[d]) + int(digits % 3) - 1;
            inside          = inside && along >= 0 && along < int(grid.n[d]);
            first_of_row += (inside ? along : 0) * stride;
            rest /= grid.n[d];
            digits /= 3;
            stride *= grid.n[d];
          }
        const unsigned int x = centre % grid.n[0];
        if (inside)
          f(first_of_row + (x > 0 ? x - 1 : 0),
            first_of_row + std::min(x + 1, grid.n[0] - 1));
      }
  }
} // namespace Morsel::SPH

#endif
