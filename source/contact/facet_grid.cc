#include <morsel/contact/facet_grid.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Contact
{
  namespace
  {
    /// A surface that is large beside its reach is not worth more squares per
    /// facet than this.
    constexpr double squares_per_facet = 16.;
  } // namespace


  FacetGrid::FacetGrid(const Surface &surface, const double reach)
      : lower(surface.nodes.front())
  {
    dealii::Point<2> upper = lower;
    for (const auto &node : surface.nodes)
      for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d] = std::min(lower[d], node[d]);
          upper[d] = std::max(upper[d], node[d]);
        }
    for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] -= reach;
        upper[d] += reach;
      }
    const double area = (upper[0] - lower[0]) * (upper[1] - lower[1]);
    side              = std::max(
        reach, std::sqrt(area / (squares_per_facet * surface.facets.size())));
    for (unsigned int d = 0; d < 2; ++d)
      n[d] = 1 + static_cast<long>((upper[d] - lower[d]) / side);

    // Twice the same walk: count, then put.
    std::vector<unsigned int> filled(n[0] * n[1] + 1, 0);
    for (const bool count : {true, false})
      {
        for (unsigned int f = 0; f < surface.facets.size(); ++f)
          {
            const auto         &a = surface.nodes[surface.facets[f].first];
            const auto         &b = surface.nodes[surface.facets[f].second];
            std::array<long, 2> begin, end;
            for (unsigned int d = 0; d < 2; ++d)
              {
                begin[d] = static_cast<long>(
                    (std::min(a[d], b[d]) - reach - lower[d]) / side);
                end[d] = static_cast<long>(
                    (std::max(a[d], b[d]) + reach - lower[d]) / side);
              }
            for (long j = std::max(0l, begin[1]);
                 j <= std::min(n[1] - 1, end[1]);
                 ++j)
              for (long i = std::max(0l, begin[0]);
                   i <= std::min(n[0] - 1, end[0]);
                   ++i)
                if (count)
                  ++filled[j * n[0] + i + 1];
                else
                  facets[filled[j * n[0] + i]++] = f;
          }
        if (count)
          {
            for (unsigned int k = 1; k < filled.size(); ++k)
              filled[k] += filled[k - 1];
            first = filled;
            facets.resize(filled.back());
          }
      }
  }


  std::array<long, 2>
  FacetGrid::square(const dealii::Point<2> &x) const
  {
    return {{static_cast<long>(std::floor((x[0] - lower[0]) / side)),
             static_cast<long>(std::floor((x[1] - lower[1]) / side))}};
  }


  std::pair<unsigned int, unsigned int>
  FacetGrid::near(const dealii::Point<2> &x) const
  {
    const auto s = square(x);
    if (s[0] < 0 || s[1] < 0 || s[0] >= n[0] || s[1] >= n[1])
      return {0, 0};
    const unsigned int k = s[1] * n[0] + s[0];
    return {first[k], first[k + 1]};
  }
} // namespace Morsel::Contact
