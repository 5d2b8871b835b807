#include <morsel/contact/surface.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Contact
{
  dealii::Tensor<1, 2>
  Surface::total_force() const
  {
    dealii::Tensor<1, 2> sum;
    for (const auto &f : force)
      sum += f;
    return sum;
  }


  Surface
  rectangle_surface(const std::string      &name,
                    const dealii::Point<2> &lower,
                    const dealii::Point<2> &upper,
                    const double            node_spacing)
  {
    return polygon_surface(
        name,
        {{lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}}},
        node_spacing);
  }


  Surface
  polygon_surface(const std::string                                &name,
                  const std::vector<std::vector<dealii::Point<2>>> &loops,
                  const double node_spacing)
  {
    std::vector<dealii::Point<2>>                      nodes;
    std::vector<std::pair<unsigned int, unsigned int>> facets;
    for (const auto &corners : loops)
      {
        const unsigned int first = nodes.size();
        for (unsigned int e = 0; e < corners.size(); ++e)
          {
            const auto edge = corners[(e + 1) % corners.size()] - corners[e];
            const unsigned int n =
                std::max(1., std::ceil(edge.norm() / node_spacing - 1e-9));
            for (unsigned int k = 0; k < n; ++k)
              {
                facets.emplace_back(nodes.size(), nodes.size() + 1);
                nodes.push_back(corners[e] +
                                edge * (static_cast<double>(k) / n));
              }
          }
        facets.back().second = first;
      }
    return polyline_surface(name, nodes, facets);
  }


  Surface
  polyline_surface(
      const std::string                                        &name,
      const std::vector<dealii::Point<2>>                      &nodes,
      const std::vector<std::pair<unsigned int, unsigned int>> &facets)
  {
    Surface s;
    s.name   = name;
    s.nodes  = nodes;
    s.facets = facets;
    s.tributary.assign(nodes.size(), 0.);
    for (const auto &[k, l] : facets)
      {
        const double half = 0.5 * nodes[k].distance(nodes[l]);
        s.tributary[k] += half;
        s.tributary[l] += half;
      }
    s.velocity.resize(nodes.size());
    s.force.resize(nodes.size());
    return s;
  }


  Projection
  project(const Surface          &surface,
          const unsigned int      facet,
          const dealii::Point<2> &x)
  {
    const auto [first, second]        = surface.facets[facet];
    const auto                 a      = surface.nodes[first];
    const auto                 edge   = surface.nodes[second] - a;
    const double               length = edge.norm();
    const dealii::Tensor<1, 2> outward({edge[1] / length, -edge[0] / length});

    Projection   p;
    const double t    = (x - a) * edge / (length * length);
    p.interior        = t >= 0. && t <= 1.;
    p.parameter       = std::clamp(t, 0., 1.);
    const auto   away = x - (a + p.parameter * edge);
    const double side = away * outward;
    const double norm = away.norm();
    p.distance        = side < 0. ? -norm : norm;
    p.offset          = side;
    // Past an end of the facet the point is pushed away from the corner.
    p.normal = (p.interior || norm == 0.) ? outward
                                          : away / (side < 0. ? -norm : norm);
    return p;
  }
} // namespace Morsel::Contact
