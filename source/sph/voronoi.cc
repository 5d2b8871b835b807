#include <morsel/core/parallel.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/outline_cut.h>
#include <morsel/sph/voronoi.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    std::vector<CellFacet>
    rectangle(const Point<2> &lower, const Point<2> &upper)
    {
      const Point<2> right_bottom(upper[0], lower[1]);
      const Point<2> left_top(lower[0], upper[1]);
      const auto     none = CellFacet::no_particle;
      return {{lower, right_bottom, none, 2},
              {right_bottom, upper, none, 1},
              {upper, left_top, none, 3},
              {left_top, lower, none, 0}};
    }


    /// Cuts away what lies beyond the bisector to neighbour @p j, whose
    /// distance along @p normal is @p offset from @p middle.
    void
    clip(std::vector<CellFacet> &facets,
         const Point<2>         &middle,
         const Tensor<1, 2>     &normal,
         const unsigned int      j,
         const double            tolerance)
    {
      const auto beyond = [&](const Point<2> &p) {
        return (p - middle) * normal;
      };
      if (std::none_of(
              facets.begin(), facets.end(), [&](const CellFacet &facet) {
                return beyond(facet.first) > tolerance;
              }))
        return;
      std::vector<CellFacet> kept;
      Point<2>               leaves, enters;
      bool                   cut = false;
      for (const CellFacet &facet : facets)
        {
          const double a = beyond(facet.first), b = beyond(facet.second);
          if (a > 0. && b > 0.)
            continue;
          CellFacet rest = facet;
          if (a > 0. || b > 0.)
            {
              const Point<2> p =
                  facet.first + a / (a - b) * (facet.second - facet.first);
              (a > 0. ? rest.first : rest.second) = p;
              (a > 0. ? enters : leaves)          = p;
              cut                                 = true;
            }
          kept.push_back(rest);
        }
      if (cut)
        {
          // After the facet that ends where the boundary leaves the half
          // plane, the bisector leads back to where it enters.
          const auto after =
              std::find_if(kept.begin(), kept.end(), [&](const CellFacet &f) {
                return f.second == leaves;
              });
          kept.insert(after == kept.end() ? after : after + 1,
                      {leaves, enters, j, 0});
        }
      facets = std::move(kept);
    }


    double
    largest_distance(const std::vector<CellFacet> &facets, const Point<2> &p)
    {
      double r = 0.;
      for (const CellFacet &facet : facets)
        r = std::max(r, p.distance_square(facet.first));
      return std::sqrt(r);
    }


    void
    sort_by_distance(const std::vector<Point<2>> &points,
                     const Point<2>              &x,
                     std::vector<unsigned int>   &candidates)
    {
      std::sort(candidates.begin(), candidates.end(), [&](auto a, auto b) {
        const double r = x.distance_square(points[a]);
        const double s = x.distance_square(points[b]);
        return r != s ? r < s : a < b;
      });
    }


    void
    measure(VoronoiCell &cell, const Point<2> &origin)
    {
      Tensor<1, 2> moment;
      for (const CellFacet &facet : cell.facets)
        {
          const Tensor<1, 2> a = facet.first - origin,
                             b = facet.second - origin;
          const double area    = 0.5 * (a[0] * b[1] - a[1] * b[0]);
          cell.area += area;
          moment += area / 3. * (a + b);
        }
      cell.centroid = origin + moment / cell.area;
    }
  } // namespace


  std::vector<VoronoiCell>
  voronoi_cells(const std::vector<Point<2>> &points,
                const Point<2>              &lower,
                const Point<2>              &upper,
                const double                 spacing,
                const std::vector<char>     &wanted)
  {
    const double reach = 4. * spacing;
    CellGrid     grid;
    grid.build(points, reach);
    std::vector<VoronoiCell> cells(points.size());
    const auto               make = [&](const unsigned int         i,
                          std::vector<unsigned int> &candidates) {
      const Point<2> &x = points[i];
      sort_by_distance(points, x, candidates);
      auto &facets = cells[i].facets;
      facets       = rectangle(lower, upper);
      for (const unsigned int j : candidates)
        {
          const Tensor<1, 2> d = points[j] - x;
          const double       r = d.norm();
          if (0.5 * r > largest_distance(facets, x))
            return true;
          clip(facets, x + 0.5 * d, d / r, j, 1e-10 * spacing);
        }
      return 0.5 * reach > largest_distance(facets, x);
    };
    parallel_for(points.size(), [&](const auto begin, const auto end) {
      std::vector<unsigned int> candidates;
      for (unsigned int i = begin; i < end; ++i)
        {
          if (!wanted.empty() && !wanted[i])
            continue;
          candidates.clear();
          grid.for_each_near(points[i], [&](const unsigned int j) {
            if (j != i && points[i].distance_square(points[j]) < reach * reach)
              candidates.push_back(j);
          });
          if (!make(i, candidates))
            {
              // A hole in the cloud: every other point may be a neighbour.
              candidates.clear();
              for (unsigned int j = 0; j < points.size(); ++j)
                if (j != i)
                  candidates.push_back(j);
              make(i, candidates);
            }
          auto &facets = cells[i].facets;
          facets.erase(std::remove_if(facets.begin(),
                                      facets.end(),
                                      [&](const CellFacet &facet) {
                                        return facet.length() < 1e-9 * spacing;
                                      }),
                       facets.end());
          measure(cells[i], points[i]);
        }
    });
    return cells;
  }


  std::vector<VoronoiCell>
  voronoi_cells(const std::vector<Point<2>> &points,
                const Scene::Outline        &outline,
                const double                 spacing)
  {
    // Most cells are found from few candidates in a small box.
    const double usual_radius = 3. * spacing, usual_reach = 1.7 * spacing;
    const double grid_radius = 2. * std::sqrt(2.) * usual_reach;
    CellGrid     grid;
    grid.build(points, grid_radius);
    const OutlineCut         cut(outline, points, spacing);
    std::vector<VoronoiCell> cells(points.size());

    const auto gather = [&](const unsigned int         i,
                            const double               radius,
                            std::vector<unsigned int> &candidates) {
      candidates.clear();
      const auto add = [&](const unsigned int j) {
        if (j != i && points[i].distance_square(points[j]) <= radius * radius)
          candidates.push_back(j);
      };
      if (radius <= grid_radius)
        grid.for_each_near(points[i], add);
      else
        for (unsigned int j = 0; j < points.size(); ++j)
          add(j);
      sort_by_distance(points, points[i], candidates);
    };
    // The cell as far as a box about its point and the candidates tell.
    const auto convex_cell = [&](const unsigned int               i,
                                 const double                     reach,
                                 const std::vector<unsigned int> &candidates) {
      const Point<2>        &x = points[i];
      const Tensor<1, 2>     corner({reach, reach});
      std::vector<CellFacet> convex = rectangle(x - corner, x + corner);
      for (const unsigned int j : candidates)
        {
          const Tensor<1, 2> d = points[j] - x;
          if (0.5 * d.norm() > largest_distance(convex, x))
            break;
          clip(convex, x + 0.5 * d, d / d.norm(), j, 1e-10 * spacing);
        }
      return convex;
    };
    parallel_for(points.size(), [&](const auto begin, const auto end) {
      std::vector<unsigned int> candidates;
      for (unsigned int i = begin; i < end; ++i)
        {
          double reach = usual_reach;
          while (cells[i].facets.empty())
            {
              gather(i, usual_radius, candidates);
              auto         convex = convex_cell(i, reach, candidates);
              const double needed = 2. * largest_distance(convex, points[i]);
              if (needed > usual_radius)
                {
                  gather(i, needed, candidates);
                  convex = convex_cell(i, reach, candidates);
                }
              cells[i].facets = cut(i, convex);
              reach *= 2.;
            }
          measure(cells[i], points[i]);
        }
    });
    return cells;
  }
} // namespace Morsel::SPH
