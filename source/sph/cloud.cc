#include <morsel/core/errors.h>
#include <morsel/sph/cloud.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/visibility.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <utility>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using Fracture::Crack;

  namespace
  {
    constexpr unsigned int nothing = static_cast<unsigned int>(-1);

    constexpr unsigned int rows_along_crack   = 3;
    constexpr unsigned int columns_beyond_tip = 3;
    constexpr unsigned int relaxations        = 20;


    /// A particle while the cloud is being made.
    struct Seed
    {
      Point<2>     position;
      bool         fixed  = false;   ///< not to be relaxed
      unsigned int source = nothing; ///< seed whose random offset it takes,
      Tensor<2, 2> image;            ///< mirrored by this; nothing: its own
    };


    double
    depth_inside(const Filling &filling, const Point<2> &p)
    {
      return std::min({p[0] - filling.lower[0],
                       filling.upper[0] - p[0],
                       p[1] - filling.lower[1],
                       filling.upper[1] - p[1]});
    }


    /// The part of a segment that lies in the rectangle: mouths reach beyond
    /// it.
    std::pair<Point<2>, Point<2>>
    trimmed(const Filling &filling, const Point<2> &a, const Point<2> &b)
    {
      double             begin = 0., end = 1.;
      const Tensor<1, 2> d = b - a;
      for (unsigned int k = 0; k < 2; ++k)
        if (d[k] != 0.)
          {
            const double s = (filling.lower[k] - a[k]) / d[k];
            const double t = (filling.upper[k] - a[k]) / d[k];
            begin          = std::max(begin, std::min(s, t));
            end            = std::min(end, std::max(s, t));
          }
      return {a + begin * d, a + end * d};
    }


    /// Whether a place is free of seeds within @p distance.
    bool
    is_free(const std::vector<Seed> &seeds,
            const Point<2>          &p,
            const double             distance)
    {
      for (const Seed &seed : seeds)
        if (seed.position.distance_square(p) < distance * distance)
          return false;
      return true;
    }


    /// Whether a place keeps clear of all cracks but one.
    bool
    keeps_clear(const std::vector<Crack> &cracks,
                const Crack              &own,
                const Point<2>           &p,
                const double              distance)
    {
      return std::all_of(cracks.begin(), cracks.end(), [&](const Crack &crack) {
        return &crack == &own || crack.distance(p) > distance;
      });
    }


    /// I - 2 n (x) n.
    Tensor<2, 2>
    reflection(const Tensor<1, 2> &n)
    {
      return Tensor<2, 2>(dealii::unit_symmetric_tensor<2>()) -
             2. * outer_product(n, n);
    }


    /// Two seeds face to face across a crack.
    /// @param next_to_crack their offsets are mirror images
    /// @param behind the first of the two on the other side of a tip, whose
    ///   offset theirs mirror, too: the tip stays a corner of their cells
    void
    add_pair(const bool          next_to_crack,
             const Point<2>     &up,
             const Point<2>     &down,
             const Tensor<1, 2> &normal,
             const unsigned int  behind,
             std::vector<Seed>  &seeds)
    {
      Seed seed;
      seed.position = up;
      seed.fixed    = true;
      if (next_to_crack)
        {
          const Tensor<1, 2> along({normal[1], -normal[0]});
          seed.source = behind == nothing ? seeds.size() : seeds[behind].source;
          seed.image  = behind == nothing
                            ? Tensor<2, 2>(dealii::unit_symmetric_tensor<2>())
                            : reflection(along) * seeds[behind].image;
        }
      seeds.push_back(seed);
      seed.position = down;
      seed.image    = reflection(normal) * seed.image;
      seeds.push_back(seed);
    }


    /// Rows on both sides of each segment, half a spacing off it and further,
    /// the nearest first. Columns divide the segment evenly and are carried
    /// on beyond a tip.
    void
    add_rows_along_cracks(const Filling            &filling,
                          const std::vector<Crack> &cracks,
                          const double              spacing,
                          std::vector<Seed>        &seeds)
    {
      for (unsigned int row = 0; row < rows_along_crack; ++row)
        for (const Crack &crack : cracks)
          {
            const auto        &v = crack.get_vertices();
            const unsigned int n = v.size() - 1;
            for (unsigned int s = 0; s < n; ++s)
              {
                const auto [begin, end]   = trimmed(filling, v[s], v[s + 1]);
                const double       length = begin.distance(end);
                const Tensor<1, 2> t      = (end - begin) / length;
                const Tensor<1, 2> normal({-t[1], t[0]});
                const int          columns = std::max(
                    1, static_cast<int>(std::lround(length / spacing)));
                const int before =
                    s == 0 && crack.has_tip(0) ? columns_beyond_tip : 0;
                const int after =
                    s + 1 == n && crack.has_tip(1) ? columns_beyond_tip : 0;
                int last_column = std::numeric_limits<int>::max();
                for (int c = -before; c < columns + after; ++c)
                  {
                    const Point<2> foot =
                        begin + (c + 0.5) * length / columns * t;
                    const Tensor<1, 2> off = (row + 0.5) * spacing * normal;
                    const Point<2>     up = foot + off, down = foot - off;
                    const auto         usable = [&](const Point<2> &p) {
                      return depth_inside(filling, p) >= 0.3 * spacing &&
                             is_free(seeds, p, 0.7 * spacing) &&
                             keeps_clear(cracks, crack, p, 0.4 * spacing);
                    };
                    if (!usable(up) || !usable(down))
                      continue;
                    const unsigned int behind =
                        c - 1 == last_column ? seeds.size() - 2 : nothing;
                    const bool behind_tip =
                        (c == 0 && before > 0) || (c == columns && after > 0);
                    add_pair(row == 0,
                             up,
                             down,
                             normal,
                             behind_tip ? behind : nothing,
                             seeds);
                    last_column = c;
                  }
              }
          }
    }


    std::vector<Point<2>>
    positions(const std::vector<Seed> &seeds)
    {
      std::vector<Point<2>> result;
      for (const Seed &seed : seeds)
        result.push_back(seed.position);
      return result;
    }


    /// Lloyd iterations of what is not fixed near the rows along the cracks.
    void
    relax(const Filling     &filling,
          const double       spacing,
          std::vector<Seed> &seeds)
    {
      std::vector<char> moves(seeds.size(), false);
      bool              any = false;
      for (unsigned int i = 0; i < seeds.size(); ++i)
        if (!seeds[i].fixed &&
            depth_inside(filling, seeds[i].position) > 0.75 * spacing)
          for (const Seed &row : seeds)
            if (row.fixed && row.position.distance_square(seeds[i].position) <
                                 9. * spacing * spacing)
              moves[i] = any = true;
      double largest_move = any ? spacing : 0.;
      for (unsigned int step = 0;
           step < relaxations && largest_move > 1e-6 * spacing;
           ++step)
        {
          const auto cells = voronoi_cells(
              positions(seeds), filling.lower, filling.upper, spacing, moves);
          largest_move = 0.;
          for (unsigned int i = 0; i < seeds.size(); ++i)
            if (moves[i])
              {
                largest_move =
                    std::max(largest_move,
                             seeds[i].position.distance(cells[i].centroid));
                seeds[i].position = cells[i].centroid;
              }
        }
    }


    /// Random offsets, mirrored across a crack that runs between two rows.
    void
    scatter(const Filling     &filling,
            const double       spacing,
            std::vector<Seed> &seeds)
    {
      std::mt19937_64 generator(filling.seed);
      const auto      draw = [&] {
        return (2. * ((generator() >> 11) * 0x1.0p-53) - 1.) * filling.scatter *
               spacing;
      };
      std::vector<Tensor<1, 2>> offsets;
      for (unsigned int i = 0; i < seeds.size(); ++i)
        {
          const double x = draw(), y = draw();
          offsets.push_back(Tensor<1, 2>({x, y}));
        }
      for (unsigned int i = 0; i < seeds.size(); ++i)
        seeds[i].position += seeds[i].source == nothing
                                 ? offsets[i]
                                 : seeds[i].image * offsets[seeds[i].source];
    }
  } // namespace


  Cloud
  fill_rectangle(const Filling &filling, const std::vector<Crack> &cracks)
  {
    const Tensor<1, 2> size = filling.upper - filling.lower;
    const double       dx = size[0] / filling.n_x, dy = size[1] / filling.n_y;
    Cloud              cloud;
    cloud.lower   = filling.lower;
    cloud.upper   = filling.upper;
    cloud.spacing = std::sqrt(dx * dy);

    std::vector<Seed> seeds;
    if (filling.fit_to_cracks)
      add_rows_along_cracks(filling, cracks, cloud.spacing, seeds);
    const std::vector<Seed> rows = seeds;
    for (unsigned int j = 0; j < filling.n_y; ++j)
      for (unsigned int i = 0; i < filling.n_x; ++i)
        {
          Seed seed;
          seed.position =
              filling.lower + Tensor<1, 2>({(i + 0.5) * dx, (j + 0.5) * dy});
          if (is_free(rows, seed.position, 0.7 * cloud.spacing))
            seeds.push_back(seed);
        }
    relax(filling, cloud.spacing, seeds);
    if (filling.scatter > 0.)
      scatter(filling, cloud.spacing, seeds);

    cloud.points = positions(seeds);
    check_off_cracks(cloud.points,
                     cracks,
                     cloud.spacing,
                     "choose numbers of particles that put no row there (even "
                     "ones for a crack at mid height), or set 'SPH/Fit to "
                     "cracks = true'.");
    cloud.cells =
        voronoi_cells(cloud.points, cloud.lower, cloud.upper, cloud.spacing);
    return cloud;
  }
} // namespace Morsel::SPH
