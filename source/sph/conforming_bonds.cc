#include <morsel/sph/bonds.h>
#include <morsel/sph/conforming_weights.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    constexpr unsigned int elsewhere = -1;


    double
    longest_pair(const NeighbourList                 &list,
                 const std::vector<dealii::Point<2>> &points)
    {
      double longest = 0.;
      for (unsigned int i = 0; i < list.n_rows(); ++i)
        for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
          longest =
              std::max(longest, points[i].distance(points[list.index[k]]));
      return longest;
    }


    /// Where the particles of a whole body stand in this rank's arrays.
    std::vector<unsigned int>
    places_of(const std::vector<unsigned long long> &local_ids,
              const unsigned int                     n_of_body)
    {
      std::vector<unsigned int> place(n_of_body, elsewhere);
      for (unsigned int i = 0; i < local_ids.size(); ++i)
        place[local_ids[i]] = i;
      return place;
    }


    /// Calls f(i, j, k) for the pairs of a whole body of which this rank knows
    /// both particles: their places and the entry.
    template <typename Function>
    void
    for_each_local(const NeighbourList                   &whole,
                   const std::vector<unsigned long long> &ids,
                   const std::vector<unsigned int>       &place,
                   const Function                        &f)
    {
      for (unsigned int i = 0; i < ids.size(); ++i)
        for (unsigned int k = whole.start[ids[i]]; k < whole.start[ids[i] + 1];
             ++k)
          if (const unsigned int j = place[whole.index[k]]; j != elsewhere)
            f(i, j, k);
    }


    NeighbourList
    sorted_list(std::vector<std::vector<unsigned int>> &&rows)
    {
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


  ConformingWeights::ConformingWeights(const Cloud      &cloud,
                                       const Kernel     &kernel,
                                       const Visibility &visibility)
  {
    const ShapeFunctions shape(cloud, kernel, visibility);
    gradient = conforming_gradient(shape);
    control  = residual_control(shape, 1.);
    reach    = std::max(longest_pair(gradient.list, cloud.points),
                     longest_pair(control.list, cloud.points));
  }


  void
  Bonds::build_conforming(const Particles         &particles,
                          const ConformingWeights &whole,
                          const Kernel            &kernel)
  {
    const std::vector<double>      &area = whole.gradient.volume;
    const std::vector<unsigned int> place =
        places_of(particles.id, area.size());

    // All pairs of both lists, in both directions.
    std::vector<std::vector<unsigned int>> rows(particles.id.size());
    for (const NeighbourList *pairs :
         {&whole.gradient.list, &whole.control.list})
      for_each_local(
          *pairs,
          particles.id,
          place,
          [&](const unsigned int i, const unsigned int j, const unsigned int) {
            rows[i].push_back(j);
            rows[j].push_back(i);
          });
    list = sorted_list(std::move(rows));

    weight.assign(list.index.size(), 0.);
    own.assign(list.index.size(), {0., 0.});
    back.assign(list.index.size(), {0., 0.});
    live.assign(list.index.size(), true);
    for_each_local(
        whole.control.list,
        particles.id,
        place,
        [&](const unsigned int i, const unsigned int j, const unsigned int k) {
          weight[find(i, j)] =
              whole.control.stiffness[k] / area[particles.id[i]];
        });
    for_each_local(
        whole.gradient.list,
        particles.id,
        place,
        [&](const unsigned int i, const unsigned int j, const unsigned int k) {
          const auto  &G     = whole.gradient.weight[k];
          const double ratio = area[particles.id[i]] / area[particles.id[j]];
          own[find(i, j)]    = {G[0], G[1]};
          back[find(j, i)]   = {ratio * G[0], ratio * G[1]};
        });
    // sum_j V_j W_ij n (x) n, n the directions of the neighbours.
    full_moment =
        0.5 * (1. - particles.spacing * particles.spacing * kernel.value(0.));
    pack_conforming(particles, kernel);
  }


  void
  Bonds::pack_conforming(const Particles &particles, const Kernel &kernel)
  {
    pack(particles, particles.n_owned);
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
