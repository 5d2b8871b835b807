#include <morsel/measure/perimeter.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Morsel::Measure
{
  using dealii::ArrayView;
  using dealii::Point;

  namespace
  {
    using Integers = std::array<int, 2>;

    /// Steps along the boundary, by Freeman's code.
    constexpr std::array<Integers, 4> steps{
        {{{1, 0}}, {{0, 1}}, {{-1, 0}}, {{0, -1}}}};


    /// The closed curves around the pixels, as Freeman codes with the pixels
    /// on the left.
    class BoundaryTracer
    {
    public:
      explicit BoundaryTracer(const std::vector<Integers> &pixels)
      {
        lower = upper = pixels.front();
        for (const auto &p : pixels)
          for (unsigned int d = 0; d < 2; ++d)
            {
              lower[d] = std::min(lower[d], p[d]);
              upper[d] = std::max(upper[d], p[d]);
            }
        // One empty pixel on every side spares all range checks.
        width = upper[0] - lower[0] + 3;
        filled.assign(width * (upper[1] - lower[1] + 3), 0);
        for (const auto &p : pixels)
          filled[index(p[0], p[1])] = 1;
      }

      std::vector<std::vector<int>>
      curves()
      {
        mark_edges();
        std::vector<std::vector<int>> result;
        for (std::size_t vertex = 0; vertex < edges.size(); ++vertex)
          while (edges[vertex] != 0)
            result.push_back(follow(vertex));
        return result;
      }

    private:
      std::size_t
      index(const int x, const int y) const
      {
        return static_cast<std::size_t>(y - lower[1] + 1) * width +
               (x - lower[0] + 1);
      }

      /// Bit c of a vertex (named after the pixel above and right of it) says
      /// that a boundary edge with code c leaves it.
      void
      mark_edges()
      {
        edges.assign(filled.size(), 0);
        for (int y = lower[1]; y <= upper[1]; ++y)
          for (int x = lower[0]; x <= upper[0]; ++x)
            if (filled[index(x, y)])
              {
                if (!filled[index(x, y - 1)])
                  edges[index(x, y)] |= 1 << 0;
                if (!filled[index(x + 1, y)])
                  edges[index(x + 1, y)] |= 1 << 1;
                if (!filled[index(x, y + 1)])
                  edges[index(x + 1, y + 1)] |= 1 << 2;
                if (!filled[index(x - 1, y)])
                  edges[index(x, y + 1)] |= 1 << 3;
              }
      }

      std::vector<int>
      follow(std::size_t vertex)
      {
        const std::size_t start = vertex;
        std::vector<int>  codes;
        int               code = 0;
        while ((edges[vertex] & (1 << code)) == 0)
          ++code;
        const int start_code = code;
        do
          {
            codes.push_back(code);
            vertex += steps[code][0] +
                      static_cast<std::ptrdiff_t>(width) * steps[code][1];
            // Turning left first keeps pixels that meet at a corner apart.
            for (const int turn : {1, 0, 3})
              if (edges[vertex] & (1 << ((code + turn) % 4)))
                {
                  code = (code + turn) % 4;
                  break;
                }
            edges[vertex] &= ~(1 << code);
        } while (vertex != start || code != start_code);
        return codes;
      }

      Integers                   lower, upper;
      std::size_t                width;
      std::vector<char>          filled;
      std::vector<unsigned char> edges;
    };


    /// A digital straight segment that grows by one step at a time: points
    /// with mu <= a x - b y < mu + a + b in the frame of its first step.
    class StraightSegment
    {
    public:
      explicit StraightSegment(const int first_code)
          : first_code(first_code)
      {}

      /// Adds the step if the segment stays straight.
      bool
      extend(const int code)
      {
        const int turn      = (code - first_code + 4) % 4;
        const int this_side = turn == 1 ? 1 : -1;
        if (turn == 2 || (turn != 0 && side != 0 && side != this_side))
          return false;
        const std::array<long, 2> p{
            {last[0] + (turn == 0 ? 1 : 0), last[1] + (turn == 0 ? 0 : 1)}};
        const long r = a * p[0] - b * p[1];
        if (r < mu - 1 || r > mu + a + b)
          return false;

        if (r == mu - 1) // just above: turns counter-clockwise
          {
            lower_first = lower_last;
            upper_last  = p;
            a           = p[1] - upper_first[1];
            b           = p[0] - upper_first[0];
            mu          = a * p[0] - b * p[1];
          }
        else if (r == mu + a + b) // just below: turns clockwise
          {
            upper_first = upper_last;
            lower_last  = p;
            a           = p[1] - lower_first[1];
            b           = p[0] - lower_first[0];
            mu          = a * p[0] - b * p[1] - a - b + 1;
          }
        else
          {
            if (r == mu)
              upper_last = p;
            if (r == mu + a + b - 1)
              lower_last = p;
          }
        last = p;
        if (turn != 0)
          side = this_side;
        return true;
      }

      std::array<double, 2>
      direction() const
      {
        const auto  &along  = steps[first_code];
        const auto  &across = steps[(first_code + (side < 0 ? 3 : 1)) % 4];
        const double norm   = std::hypot(a, b);
        return {{(b * along[0] + a * across[0]) / norm,
                 (b * along[1] + a * across[1]) / norm}};
      }

    private:
      using Longs = std::array<long, 2>;

      int   first_code;
      int   side = 0; ///< other steps: +1 to the left, -1 to the right
      long  a = 0, b = 1, mu = 0;
      Longs last{{1, 0}};
      Longs upper_first{{0, 0}}, upper_last{{1, 0}};
      Longs lower_first{{0, 0}}, lower_last{{1, 0}};
    };


    /// Weight of a segment for an edge at the relative place u in it: smooth,
    /// 0 at both ends, 1 in the middle (Lachaud et al. 2007, eq. 5).
    double
    centrality(const double u)
    {
      const double v = u * (1. - u);
      return 64. * v * v * v;
    }


    double
    curve_length(const std::vector<int> &codes)
    {
      const std::size_t                  n = codes.size();
      std::vector<std::array<double, 2>> tangent(n, {{0., 0.}});
      const auto                         grow = [&](const std::size_t i) {
        StraightSegment segment(codes[i]);
        std::size_t     length = 1;
        while (length < n && segment.extend(codes[(i + length) % n]))
          ++length;
        return std::make_pair(length, segment.direction());
      };

      // A segment that ends where the one before it ends is part of that one.
      std::size_t former_end = grow(n - 1).first - 1;
      for (std::size_t i = 0; i < n; ++i)
        {
          const auto [length, direction] = grow(i);
          const bool maximal             = i + length > former_end;
          former_end                     = i + length;
          if (!maximal)
            continue;
          for (std::size_t j = 0; j < length; ++j)
            {
              const double w = centrality((j + 0.5) / length);
              tangent[(i + j) % n][0] += w * direction[0];
              tangent[(i + j) % n][1] += w * direction[1];
            }
        }

      double sum = 0.;
      for (std::size_t i = 0; i < n; ++i)
        sum += std::abs(tangent[i][0] * steps[codes[i]][0] +
                        tangent[i][1] * steps[codes[i]][1]) /
               std::hypot(tangent[i][0], tangent[i][1]);
      return sum;
    }


    /// Columns and rows if the points lie on a lattice, else nothing.
    std::vector<Integers>
    lattice_pixels(const ArrayView<const Point<2>> positions,
                   const double                    spacing)
    {
      constexpr double      tolerance = 0.02;
      std::vector<Integers> pixels;
      pixels.reserve(positions.size());
      for (const auto &p : positions)
        {
          Integers pixel;
          for (unsigned int d = 0; d < 2; ++d)
            {
              const double x = (p[d] - positions[0][d]) / spacing;
              pixel[d]       = static_cast<int>(std::lround(x));
              if (std::abs(x - pixel[d]) > tolerance)
                return {};
            }
          pixels.push_back(pixel);
        }
      auto sorted = pixels;
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        return {};
      return pixels;
    }


    /// Pixels of a grid where the particles' area, smeared over a kernel
    /// (1 - (r/R)^2)^2 * 3 / (pi R^2), fills more than half.
    std::vector<Integers>
    smoothed_pixels(const ArrayView<const Point<2>> positions,
                    const ArrayView<const double>   areas,
                    const double                    pixel_width,
                    const double                    radius)
    {
      Point<2> lower = positions[0], upper = positions[0];
      for (const auto &p : positions)
        for (unsigned int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], p[d]);
            upper[d] = std::max(upper[d], p[d]);
          }
      Integers n;
      for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d] -= radius;
          n[d] =
              static_cast<int>((upper[d] + radius - lower[d]) / pixel_width) +
              2;
        }

      std::vector<double> fraction(static_cast<std::size_t>(n[0]) * n[1], 0.);
      const double        scale = 3. / (dealii::numbers::PI * radius * radius);
      for (std::size_t i = 0; i < positions.size(); ++i)
        {
          Integers begin, end;
          for (unsigned int d = 0; d < 2; ++d)
            {
              const double x = positions[i][d] - lower[d];
              begin[d] =
                  std::max(0, static_cast<int>((x - radius) / pixel_width));
              end[d] = std::min(
                  n[d], static_cast<int>((x + radius) / pixel_width) + 2);
            }
          for (int y = begin[1]; y < end[1]; ++y)
            for (int x = begin[0]; x < end[0]; ++x)
              {
                const Point<2> centre(lower[0] + (x + 0.5) * pixel_width,
                                      lower[1] + (y + 0.5) * pixel_width);
                const double   q =
                    1. - positions[i].distance_square(centre) / radius / radius;
                if (q > 0.)
                  fraction[static_cast<std::size_t>(y) * n[0] + x] +=
                      scale * areas[i] * q * q;
              }
        }

      std::vector<Integers> pixels;
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x)
          if (fraction[static_cast<std::size_t>(y) * n[0] + x] > 0.5)
            pixels.push_back({{x, y}});
      return pixels;
    }
  } // namespace


  double
  perimeter_of_pixels(const std::vector<std::array<int, 2>> &pixels)
  {
    if (pixels.empty())
      return 0.;
    double sum = 0.;
    for (const auto &curve : BoundaryTracer(pixels).curves())
      sum += curve_length(curve);
    return sum;
  }


  double
  perimeter(const ArrayView<const Point<2>> positions,
            const ArrayView<const double>   areas,
            const double                    spacing)
  {
    AssertDimension(positions.size(), areas.size());
    AssertThrow(spacing > 0., dealii::ExcMessage("No particle spacing."));
    if (positions.size() == 0)
      return 0.;

    const auto pixels = lattice_pixels(positions, spacing);
    if (!pixels.empty())
      return spacing * perimeter_of_pixels(pixels);

    // Measured: a wider kernel rounds the corners, a narrower one takes the
    // particles' disorder for edge.
    const double pixel_width = 0.5 * spacing;
    const double radius      = 2. * spacing;
    return pixel_width * perimeter_of_pixels(smoothed_pixels(
                             positions, areas, pixel_width, radius));
  }
} // namespace Morsel::Measure
