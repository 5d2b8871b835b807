#include <morsel/measure/disjoint_sets.h>
#include <morsel/measure/fragments.h>
#include <morsel/measure/perimeter.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::Measure
{
  using dealii::ArrayView;
  using dealii::Point;

  namespace
  {
    /// Particles sorted into square cells of a given width.
    struct CellGrid
    {
      CellGrid(const ArrayView<const Point<2>> positions, const double width)
          : width(width)
          , lower(positions[0])
      {
        Point<2> upper = positions[0];
        for (const auto &p : positions)
          for (unsigned int d = 0; d < 2; ++d)
            {
              lower[d] = std::min(lower[d], p[d]);
              upper[d] = std::max(upper[d], p[d]);
            }
        // A few particles far away must not ask for a grid larger than the
        // cloud: wider cells are slower, never wrong.
        const auto cells = [&](const unsigned int d) {
          return std::floor((upper[d] - lower[d]) / this->width) + 1.;
        };
        while (cells(0) * cells(1) > 16. * positions.size() + 1024.)
          this->width *= 2.;
        for (unsigned int d = 0; d < 2; ++d)
          n[d] = static_cast<std::size_t>(cells(d));

        first.assign(n[0] * n[1] + 1, 0);
        for (const auto &p : positions)
          ++first[index(p) + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        members.resize(positions.size());
        auto next = first;
        for (std::size_t i = 0; i < positions.size(); ++i)
          members[next[index(positions[i])]++] = i;
      }

      std::size_t
      coordinate(const Point<2> &p, const unsigned int d) const
      {
        return std::min(n[d] - 1,
                        static_cast<std::size_t>((p[d] - lower[d]) / width));
      }

      std::size_t
      index(const Point<2> &p) const
      {
        return coordinate(p, 1) * n[0] + coordinate(p, 0);
      }

      double                     width;
      Point<2>                   lower;
      std::size_t                n[2];
      std::vector<std::uint64_t> first;
      std::vector<std::uint32_t> members;
    };


    /// Numbers the sets by falling area, dust as -1, and sums what is known
    /// without their shape.
    Fragments
    collect(const ArrayView<const char>     alive,
            DisjointSets                   &sets,
            const ArrayView<const Point<2>> positions,
            const ArrayView<const double>   areas)
    {
      Fragments             result;
      std::vector<int>      piece_of_root(alive.size(), -1);
      std::vector<Fragment> pieces;
      std::vector<int>      unsorted(alive.size(), -1);
      double                total = 0., dust = 0.;
      for (std::size_t i = 0; i < alive.size(); ++i)
        {
          total += areas[i];
          if (!alive[i])
            {
              dust += areas[i];
              continue;
            }
          int &piece = piece_of_root[sets.root(i)];
          if (piece < 0)
            {
              piece = pieces.size();
              pieces.emplace_back();
            }
          unsorted[i] = piece;
          auto &p     = pieces[piece];
          ++p.n_particles;
          p.area += areas[i];
          p.centroid += areas[i] * positions[i];
        }

      std::vector<int> order(pieces.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return pieces[a].area > pieces[b].area;
      });
      std::vector<int> rank(pieces.size());
      for (std::size_t k = 0; k < order.size(); ++k)
        {
          rank[order[k]] = k;
          result.pieces.push_back(pieces[order[k]]);
          result.pieces.back().centroid /= result.pieces.back().area;
          result.pieces.back().share = result.pieces.back().area / total;
        }
      result.label.resize(alive.size());
      for (std::size_t i = 0; i < alive.size(); ++i)
        result.label[i] = unsorted[i] < 0 ? -1 : rank[unsorted[i]];
      result.dust_share = total > 0. ? dust / total : 0.;
      return result;
    }
  } // namespace


  double
  Fragments::largest_share() const
  {
    return count > 0 ? pieces.front().share : 0.;
  }


  BondList
  friends(const ArrayView<const Point<2>> positions, const double distance)
  {
    AssertThrow(distance > 0., dealii::ExcMessage("No distance to friends."));
    BondList bonds;
    bonds.first.reserve(positions.size() + 1);
    bonds.first.push_back(0);
    if (positions.size() == 0)
      return bonds;

    const CellGrid grid(positions, distance);
    const double   square = distance * distance;
    for (std::size_t i = 0; i < positions.size(); ++i)
      {
        const std::size_t cx = grid.coordinate(positions[i], 0);
        const std::size_t cy = grid.coordinate(positions[i], 1);
        for (std::size_t y = std::max<std::size_t>(cy, 1) - 1;
             y < std::min(cy + 2, grid.n[1]);
             ++y)
          for (std::size_t x = std::max<std::size_t>(cx, 1) - 1;
               x < std::min(cx + 2, grid.n[0]);
               ++x)
            {
              const std::size_t cell = y * grid.n[0] + x;
              for (auto k = grid.first[cell]; k < grid.first[cell + 1]; ++k)
                {
                  const std::uint32_t j = grid.members[k];
                  if (j > i &&
                      positions[i].distance_square(positions[j]) <= square)
                    bonds.neighbour.push_back(j);
                }
            }
        bonds.first.push_back(bonds.neighbour.size());
      }
    return bonds;
  }


  Fragments
  find_fragments(const ArrayView<const char>     alive,
                 const BondList                 &bonds,
                 const ArrayView<const Point<2>> positions,
                 const ArrayView<const double>   areas,
                 const double                    spacing,
                 const double                    fragment_share)
  {
    const std::size_t n = alive.size();
    AssertDimension(positions.size(), n);
    AssertDimension(areas.size(), n);
    AssertDimension(bonds.first.size(), n + 1);

    DisjointSets sets(n);
    for (std::size_t i = 0; i < n; ++i)
      if (alive[i])
        for (auto k = bonds.first[i]; k < bonds.first[i + 1]; ++k)
          if (alive[bonds.neighbour[k]])
            sets.join(i, bonds.neighbour[k]);

    Fragments result = collect(alive, sets, positions, areas);
    for (const auto &piece : result.pieces)
      if (piece.share >= fragment_share)
        ++result.count;
      else
        result.crumb_share += piece.share;

    std::vector<std::vector<Point<2>>> members(result.count);
    std::vector<std::vector<double>>   member_areas(result.count);
    for (std::size_t i = 0; i < n; ++i)
      if (const int l = result.label[i];
          l >= 0 && static_cast<unsigned int>(l) < result.count)
        {
          members[l].push_back(positions[i]);
          member_areas[l].push_back(areas[i]);
        }
    for (unsigned int f = 0; f < result.count; ++f)
      result.pieces[f].perimeter =
          perimeter(dealii::make_array_view(members[f]),
                    dealii::make_array_view(member_areas[f]),
                    spacing);
    return result;
  }
} // namespace Morsel::Measure
