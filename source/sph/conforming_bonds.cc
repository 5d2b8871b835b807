#include <morsel/sph/bonds.h>
#include <morsel/sph/discrete_gradient.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// All pairs of both lists, in both directions.
    NeighbourList
    symmetric_union(const NeighbourList &a, const NeighbourList &b)
    {
      std::vector<std::vector<unsigned int>> rows(a.n_rows());
      for (const NeighbourList *list : {&a, &b})
        for (unsigned int i = 0; i < list->n_rows(); ++i)
          for (unsigned int k = list->start[i]; k < list->start[i + 1]; ++k)
            {
              rows[i].push_back(list->index[k]);
              rows[list->index[k]].push_back(i);
            }
      NeighbourList result;
      for (std::vector<unsigned int> &row : rows)
        {
          std::sort(row.begin(), row.end());
          result.index.insert(result.index.end(),
                              row.begin(),
                              std::unique(row.begin(), row.end()));
          result.start.push_back(result.index.size());
        }
      return result;
    }
  } // namespace


  void
  Bonds::build_conforming(const Particles  &particles,
                          const Cloud      &cloud,
                          const Kernel     &kernel,
                          const Visibility &visibility)
  {
    const ShapeFunctions   shape(cloud, kernel, visibility);
    const DiscreteGradient gradient = conforming_gradient(shape);
    const ResidualControl  control  = residual_control(shape, 1.);

    list = symmetric_union(gradient.list, control.list);
    weight.assign(list.index.size(), 0.);
    own.assign(list.index.size(), {0., 0.});
    back.assign(list.index.size(), {0., 0.});
    live.assign(list.index.size(), true);
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      {
        const double area = cloud.cells[i].area;
        for (unsigned int k = control.list.start[i];
             k < control.list.start[i + 1];
             ++k)
          weight[find(i, control.list.index[k])] = control.stiffness[k] / area;
        for (unsigned int k = gradient.list.start[i];
             k < gradient.list.start[i + 1];
             ++k)
          {
            const unsigned int j     = gradient.list.index[k];
            const auto        &G     = gradient.weight[k];
            const double       ratio = area / cloud.cells[j].area;
            own[find(i, j)]          = {G[0], G[1]};
            back[find(j, i)]         = {ratio * G[0], ratio * G[1]};
          }
      }
    // sum_j V_j W_ij n (x) n, n the directions of the neighbours.
    full_moment =
        0.5 * (1. - particles.spacing * particles.spacing * kernel.value(0.));

    pack(particles, list.n_rows());
    pack([&](unsigned int, const unsigned int k) { return own[k].x; },
         packed.own_x);
    pack([&](unsigned int, const unsigned int k) { return own[k].y; },
         packed.own_y);
    pack([&](unsigned int, const unsigned int k) { return back[k].x; },
         packed.back_x);
    pack([&](unsigned int, const unsigned int k) { return back[k].y; },
         packed.back_y);
    pack(
        [&](const unsigned int i, const unsigned int k) {
          return weight[k] > 0. ? particles.area[list.index[k]] *
                                      kernel.gradient_weight(std::sqrt(
                                          length_square(particles, i, k)))
                                : 0.;
        },
        packed.damping);
  }
} // namespace Morsel::SPH
