#ifndef morsel_sph_neighbours_h
#define morsel_sph_neighbours_h

#include <deal.II/base/point.h>

#include <algorithm>

#include <vector>

namespace Morsel::SPH
{
  /// A compressed list: the entries of row i stand at
  /// [start[i], start[i+1]).
  struct NeighbourList
  {
    std::vector<unsigned int> start{0};
    std::vector<unsigned int> index;

    unsigned int
    n_rows() const
    {
      return start.size() - 1;
    }
  };


  /// Points sorted into square cells, for searches within a fixed radius.
  /// Memory grows with the number of points, not with the covered area.
  class CellGrid
  {
  public:
    /// @param points [m]; kept by reference until the next build.
    /// @param radius largest search radius [m], above 0.
    void
    build(const std::vector<dealii::Point<2>> &points, double radius);

    /// Calls f(j) for every point within @p radius cells around @p x: a
    /// superset of the points within the radius given to build().
    template <typename Function>
    void
    for_each_near(const dealii::Point<2> &x, const Function &f) const
    {
      for_each_run(x, [&](const unsigned int begin, const unsigned int end) {
        for (unsigned int k = begin; k < end; ++k)
          f(order[k]);
      });
    }

    /// The same as ranges [begin, end) of places in sorted(); @p x may lie
    /// anywhere.
    template <typename Function>
    void
    for_each_run(const dealii::Point<2> &x, const Function &f) const
    {
      const long cx = cell(x[0] - origin[0]), cy = cell(x[1] - origin[1]);
      if (cx < -1 || cx > nx)
        return;
      for (long y = std::max(0L, cy - 1); y <= std::min(ny - 1, cy + 1); ++y)
        f(begin_of(std::max(0L, cx - 1), y),
          begin_of(std::min(nx - 1, cx + 1) + 1, y));
    }

    /// The points cell by cell.
    const std::vector<unsigned int> &
    sorted() const
    {
      return order;
    }

  private:
    long
    cell(double offset) const;

    long
    begin_of(const long x, const long y) const
    {
      return cell_start[y * nx + x];
    }

    dealii::Point<2>          origin;
    double                    inverse_size = 0.;
    long                      nx = 0, ny = 0;
    std::vector<unsigned int> cell_start, order, cell_of;
  };


  /// All pairs (i, j), i < n_rows, i != j, closer than @p radius; rows are
  /// sorted by j.
  NeighbourList
  find_neighbours(const std::vector<dealii::Point<2>> &points,
                  unsigned int                         n_rows,
                  double                               radius);
} // namespace Morsel::SPH

#endif
