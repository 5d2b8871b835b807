#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/sph/body_cloud.h>
#include <morsel/sph/neighbours.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using Scene::Outline;

  namespace
  {
    using Edge = Outline::Edge;

    constexpr double closest_to_boundary = 0.25;  ///< of a lattice [dp]
    constexpr double smallest_cell       = 0.4;   ///< of a lattice [dp^2]
    constexpr double closest_pair        = 0.7;   ///< of rows and lattice [dp]
    constexpr double sharp_turn          = 0.5;   ///< of the boundary [radians]
    constexpr double smallest_move       = 0.005; ///< that is worth a step [dp]
    constexpr double facing = 0.95; ///< cosine between sides of a thin part
    /// A cell that takes more [dp^2] has a part without a particle: the corner
    /// of a lattice takes at most 1.75^2.
    constexpr double largest_cell = 3.2;


    /// The square lattice over the bounding box, turned about its middle, as
    /// far as it stands inside.
    std::vector<Point<2>>
    lattice(const Outline &outline,
            const double   dp,
            const double   margin,
            const double   angle)
    {
      const Point<2>     lower  = outline.lower();
      const Tensor<1, 2> extent = outline.upper() - lower;
      const Point<2>     middle = lower + 0.5 * extent;
      const double       turn   = angle * dealii::numbers::PI / 180.;
      const double       c = std::cos(turn), s = std::sin(turn);
      // Rows that a turned lattice needs beyond the box on each side.
      const int rows =
          angle == 0. ? 0
                      : static_cast<int>(std::ceil(0.5 * extent.norm() / dp));
      const auto count = [&](const unsigned int d) {
        return static_cast<int>(std::ceil(extent[d] / dp - 1e-6));
      };
      std::vector<Point<2>> points;
      for (int y = -rows; y < count(1) + rows; ++y)
        for (int x = -rows; x < count(0) + rows; ++x)
          {
            const Point<2> straight =
                lower + dp * Tensor<1, 2>({x + 0.5, y + 0.5});
            const Tensor<1, 2> r = straight - middle;
            const Point<2>     p =
                angle == 0. ? straight
                                : middle + Tensor<1, 2>({c * r[0] - s * r[1],
                                                         s * r[0] + c * r[1]});
            if (outline.contains(p) &&
                outline.distance(p) >= (margin - 1e-6) * dp)
              points.push_back(p);
          }
      return points;
    }


    /// Takes points away until no cell is a sliver, the smallest one first
    /// among its neighbours.
    void
    remove_slivers(const Outline &outline, Cloud &cloud)
    {
      const double least = smallest_cell * cloud.spacing * cloud.spacing;
      for (bool found = true; found;)
        {
          found = false;
          std::vector<Point<2>> kept;
          for (unsigned int i = 0; i < cloud.size(); ++i)
            {
              const VoronoiCell &cell = cloud.cells[i];
              bool               goes = cell.area < least;
              for (const CellFacet &facet : cell.facets)
                if (goes && !facet.at_boundary())
                  {
                    const double other = cloud.cells[facet.neighbour].area;
                    goes               = cell.area < other ||
                           (cell.area == other && i < facet.neighbour);
                  }
              if (!goes)
                kept.push_back(cloud.points[i]);
              found = found || goes;
            }
          if (found)
            {
              cloud.points = kept;
              cloud.cells = voronoi_cells(cloud.points, outline, cloud.spacing);
            }
        }
    }


    /// Whether the boundary has a corner between two edges.
    bool
    is_corner(const Edge &edge, const Edge &next)
    {
      return edge.direction() * next.direction() < std::cos(sharp_turn);
    }


    /// Points half a spacing inside of a run of edges without a corner, at
    /// even distances along it.
    void
    add_row(const std::vector<const Edge *> &run,
            const double                     dp,
            std::vector<Point<2>>           &row)
    {
      double length = 0.;
      for (const Edge *edge : run)
        length += edge->length();
      const unsigned int n =
          std::max(1u, static_cast<unsigned int>(std::lround(length / dp)));
      unsigned int k     = 0;
      double       begin = 0.;
      for (const Edge *edge : run)
        {
          const Tensor<1, 2> t = edge->direction();
          for (; k < n && (k + 0.5) * length / n <= begin + edge->length(); ++k)
            row.push_back(edge->first + ((k + 0.5) * length / n - begin) * t +
                          0.5 * dp * Tensor<1, 2>({-t[1], t[0]}));
          begin += edge->length();
        }
    }


    /// Rows along all of the boundary, corner by corner.
    std::vector<Point<2>>
    rows(const Outline &outline, const double dp)
    {
      std::vector<Point<2>> result;
      const auto           &edges  = outline.get_edges();
      const auto           &starts = outline.loop_starts();
      for (unsigned int l = 0; l + 1 < starts.size(); ++l)
        {
          const unsigned int n  = starts[l + 1] - starts[l];
          const auto         at = [&](const unsigned int k) {
            return &edges[starts[l] + k % n];
          };
          unsigned int first = 0;
          while (first < n && !is_corner(*at(first + n - 1), *at(first)))
            ++first;
          std::vector<const Edge *> run;
          for (unsigned int k = 0; k < n; ++k)
            {
              run.push_back(at(first + k));
              if (k + 1 == n || is_corner(*at(first + k), *at(first + k + 1)))
                {
                  add_row(run, dp, result);
                  run.clear();
                }
            }
        }
      return result;
    }


    /// Those of @p points that stand apart from the ones before, inside.
    void
    add_apart(const Outline               &outline,
              const std::vector<Point<2>> &points,
              const double                 margin,
              const double                 distance,
              std::vector<Point<2>>       &result)
    {
      // In cells of that distance, whose neighbours hold all that is near.
      CellGrid              grid;
      std::vector<Point<2>> all = result;
      all.insert(all.end(), points.begin(), points.end());
      grid.build(all, distance);
      std::vector<char> taken(all.size(), false);
      std::fill(taken.begin(), taken.begin() + result.size(), true);
      const unsigned int n_before = result.size();
      for (unsigned int i = n_before; i < all.size(); ++i)
        {
          bool is_free =
              outline.contains(all[i]) && outline.distance(all[i]) >= margin;
          grid.for_each_near(all[i], [&](const unsigned int j) {
            is_free = is_free && !(taken[j] && all[i].distance_square(all[j]) <
                                                   distance * distance);
          });
          if (is_free)
            {
              taken[i] = true;
              result.push_back(all[i]);
            }
        }
    }


    /// Lloyd iterations.
    void
    relax(const Outline &outline, const unsigned int most_steps, Cloud &cloud)
    {
      double largest_move = cloud.spacing;
      while (cloud.n_relaxations < most_steps &&
             largest_move > smallest_move * cloud.spacing)
        {
          largest_move = 0.;
          for (unsigned int i = 0; i < cloud.size(); ++i)
            {
              // The centroid of a cell about a notch may lie in the notch.
              const Point<2> &centroid = cloud.cells[i].centroid;
              if (!outline.contains(centroid))
                continue;
              largest_move =
                  std::max(largest_move, cloud.points[i].distance(centroid));
              cloud.points[i] = centroid;
            }
          cloud.cells = voronoi_cells(cloud.points, outline, cloud.spacing);
          ++cloud.n_relaxations;
        }
    }


    /// Random offsets that leave particles inside.
    void
    scatter(const Outline     &outline,
            const double       share,
            const unsigned int seed,
            Cloud             &cloud)
    {
      std::mt19937 generator(seed);
      // Not uniform_real_distribution, which differs between libraries.
      const auto draw = [&] {
        return share * cloud.spacing * (2. * (generator() / 4294967295.) - 1.);
      };
      for (Point<2> &p : cloud.points)
        {
          const double   x = draw(), y = draw();
          const Point<2> q = p + Tensor<1, 2>({x, y});
          if (outline.contains(q) && outline.distance(q) > 0.1 * cloud.spacing)
            p = q;
        }
      cloud.cells = voronoi_cells(cloud.points, outline, cloud.spacing);
    }


    /// Whether a cell has facets that face each other on two parts of the
    /// boundary, between which it has neighbours.
    bool
    reaches_across(const VoronoiCell &cell)
    {
      std::vector<std::vector<Tensor<1, 2>>> normals(1);
      for (const CellFacet &facet : cell.facets)
        if (facet.at_boundary())
          normals.back().push_back(facet.normal());
        else if (!normals.back().empty())
          normals.emplace_back();
      // The list begins anywhere around the cell.
      if (!cell.facets.front().at_boundary() ||
          !cell.facets.back().at_boundary())
        normals.emplace_back();
      else if (normals.size() > 1)
        {
          normals.front().insert(normals.front().end(),
                                 normals.back().begin(),
                                 normals.back().end());
          normals.back().clear();
        }
      for (unsigned int a = 0; a < normals.size(); ++a)
        for (unsigned int b = 0; b < a; ++b)
          for (const Tensor<1, 2> &n : normals[a])
            for (const Tensor<1, 2> &m : normals[b])
              if (n * m < -facing)
                return true;
      return false;
    }


    /// Refuses bodies that have not two particles across everywhere.
    void
    check_thickness(const Scene::ParticleBody &body, const Cloud &cloud)
    {
      for (unsigned int i = 0; i < cloud.size(); ++i)
        if (reaches_across(cloud.cells[i]) ||
            cloud.cells[i].area > largest_cell * cloud.spacing * cloud.spacing)
          throw InputError(
              "Body '" + body.name + "' is thinner than two particles about (" +
              number_text(cloud.points[i][0]) + ", " +
              number_text(cloud.points[i][1]) + ") m: raise 'Body " +
              body.name + "/Particles/Particles across' (a spacing of " +
              number_text(cloud.spacing) +
              " m now), or make it thicker there.");
    }
  } // namespace


  Cloud
  body_cloud(const Scene::ParticleBody &body, const unsigned int seed)
  {
    const Outline outline = body.shape.outline();
    Cloud         cloud;
    cloud.lower   = outline.lower();
    cloud.upper   = outline.upper();
    cloud.spacing = body.spacing;
    if (body.is_plain_lattice())
      {
        cloud.points = body.positions(seed);
        cloud.cells  = voronoi_cells(
            cloud.points, cloud.lower, cloud.upper, cloud.spacing);
        return cloud;
      }

    if (body.filling == "relaxed")
      {
        const double dp = cloud.spacing;
        add_apart(outline,
                  rows(outline, dp),
                  0.3 * dp,
                  closest_pair * dp,
                  cloud.points);
        add_apart(outline,
                  lattice(outline, dp, 1., body.lattice_angle),
                  0.,
                  closest_pair * dp,
                  cloud.points);
      }
    else
      cloud.points = lattice(
          outline, cloud.spacing, closest_to_boundary, body.lattice_angle);
    if (cloud.size() < 9)
      throw InputError("Body '" + body.name + "' has room for " +
                       std::to_string(cloud.size()) +
                       " particle(s), but needs at least 9: raise 'Body " +
                       body.name + "/Particles/Particles across'.");
    cloud.cells = voronoi_cells(cloud.points, outline, cloud.spacing);
    if (body.filling == "relaxed")
      relax(outline, body.relaxations, cloud);
    else
      remove_slivers(outline, cloud);
    if (body.scatter > 0.)
      scatter(outline, body.scatter, seed, cloud);
    check_thickness(body, cloud);
    return cloud;
  }


  Evenness
  evenness(const Cloud &cloud)
  {
    double mean = 0.;
    for (const VoronoiCell &cell : cloud.cells)
      mean += cell.area / cloud.size();
    Evenness result;
    result.smallest = 1e300;
    for (const VoronoiCell &cell : cloud.cells)
      {
        const double share = cell.area / mean;
        result.smallest    = std::min(result.smallest, share);
        result.largest     = std::max(result.largest, share);
        result.deviation += (share - 1.) * (share - 1.) / cloud.size();
      }
    result.deviation = std::sqrt(result.deviation);
    return result;
  }
} // namespace Morsel::SPH
