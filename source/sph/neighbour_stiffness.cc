#include <morsel/sph/neighbour_stiffness.h>

#include <array>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Flatter triangles than this, in spacings squared, are left out.
    constexpr double smallest_double_area = 0.1;

    /// Springs along the pairs keep what no triangle holds, in units of the
    /// shear modulus.
    constexpr double spring_share = 0.01;


    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }


    /// Adds weight (lambda (g_a (x) g_b) + mu (g_b (x) g_a + g_a.g_b I)).
    void
    add_block(const unsigned int                   a,
              const unsigned int                   b,
              const Tensor<1, 2>                  &g_a,
              const Tensor<1, 2>                  &g_b,
              const double                         weight,
              const Fracture::ElasticPlane        &material,
              std::vector<Eigen::Triplet<double>> &entries)
    {
      const double dot = g_a * g_b;
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int e = 0; e < 2; ++e)
          if (2 * a + d >= 2 * b + e)
            entries.emplace_back(
                2 * a + d,
                2 * b + e,
                weight *
                    (material.lambda * g_a[d] * g_b[e] +
                     material.mu * (g_b[d] * g_a[e] + (d == e ? dot : 0.))));
    }


    void
    add_spring(const unsigned int                   i,
               const unsigned int                   j,
               const double                         stiffness,
               std::vector<Eigen::Triplet<double>> &entries)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          entries.emplace_back(2 * i + d, 2 * i + d, stiffness);
          entries.emplace_back(2 * j + d, 2 * j + d, stiffness);
          entries.emplace_back(
              2 * std::max(i, j) + d, 2 * std::min(i, j) + d, -stiffness);
        }
    }
  } // namespace


  std::vector<Eigen::Triplet<double>>
  neighbour_stiffness(const ShapeFunctions         &shape,
                      const Fracture::ElasticPlane &material)
  {
    const Cloud                        &cloud = shape.get_cloud();
    std::vector<Eigen::Triplet<double>> entries;
    const auto connected = [&](const unsigned int i, const CellFacet &facet) {
      return !facet.at_boundary() &&
             shape.get_visibility().sees(cloud.points[i],
                                         cloud.points[facet.neighbour]);
    };
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        const Point<2>    &x      = cloud.points[i];
        const auto        &facets = cloud.cells[i].facets;
        const unsigned int n      = facets.size();
        for (unsigned int f = 0; f < n; ++f)
          {
            const CellFacet &one = facets[f], &other = facets[(f + 1) % n];
            if (!connected(i, one))
              continue;
            const unsigned int j = one.neighbour;
            if (i < j)
              add_spring(i,
                         j,
                         spring_share * material.mu * one.length() /
                             x.distance(cloud.points[j]),
                         entries);
            if (!connected(i, other))
              continue;
            const unsigned int k = other.neighbour;
            const Tensor<1, 2> a = cloud.points[j] - x, b = cloud.points[k] - x;
            const double       double_area = cross(a, b);
            if (double_area <
                smallest_double_area * cloud.spacing * cloud.spacing)
              continue;
            // From the particle over half of either facet to their corner.
            const double weight = 0.5 * (cross(0.5 * a, one.second - x) +
                                         cross(one.second - x, 0.5 * b));
            if (weight <= 0.)
              continue;
            const Tensor<1, 2> g_j({b[1] / double_area, -b[0] / double_area});
            const Tensor<1, 2> g_k({-a[1] / double_area, a[0] / double_area});
            const std::array<unsigned int, 3> nodes{{i, j, k}};
            const std::array<Tensor<1, 2>, 3> g{{-g_j - g_k, g_j, g_k}};
            for (unsigned int p = 0; p < 3; ++p)
              for (unsigned int q = 0; q < 3; ++q)
                if (nodes[p] >= nodes[q])
                  add_block(nodes[p],
                            nodes[q],
                            g[p],
                            g[q],
                            weight,
                            material,
                            entries);
          }
      }
    return entries;
  }
} // namespace Morsel::SPH
