#include <morsel/sph/bonds.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  void
  Bonds::build(const Particles  &particles,
               const Kernel     &kernel,
               const Visibility &visibility)
  {
    list = find_neighbours(
        particles.reference, particles.n_owned, kernel.support());
    keep_visible(list, particles.reference, visibility);
    set_offsets(particles);
    weight.resize(list.index.size());
    for (unsigned int k = 0; k < weight.size(); ++k)
      weight[k] = particles.area[list.index[k]] *
                  kernel.gradient_weight(std::sqrt(length_square(k)));
    live.assign(weight.size(), true);
    pack();
  }


  void
  Bonds::set_offsets(const Particles &particles)
  {
    dx.resize(list.index.size());
    dy.resize(list.index.size());
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        {
          const auto X =
              particles.reference[list.index[k]] - particles.reference[i];
          dx[k] = X[0];
          dy[k] = X[1];
        }
  }


  void
  Bonds::pack()
  {
    const unsigned int n_rows   = list.n_rows();
    const unsigned int n_groups = (n_rows + group_size - 1) / group_size;
    packed.slot_begin.assign(1, 0);
    for (unsigned int g = 0; g < n_groups; ++g)
      {
        unsigned int longest = 0;
        for (unsigned int i = g * group_size;
             i < std::min(n_rows, (g + 1) * group_size);
             ++i)
          longest = std::max(longest, list.start[i + 1] - list.start[i]);
        packed.slot_begin.push_back(packed.slot_begin.back() + longest);
      }
    packed.slot_end.assign(packed.slot_begin.begin() + 1,
                           packed.slot_begin.end());

    const unsigned int size = packed.slot_begin.back() * group_size;
    packed.index.resize(size, 0);
    packed.place.resize(list.index.size());
    for (unsigned int i = 0; i < n_groups * group_size; ++i)
      {
        const unsigned int g     = i / group_size;
        const unsigned int row   = std::min(i, n_rows - 1);
        const unsigned int begin = list.start[row];
        const unsigned int n     = i < n_rows ? list.start[i + 1] - begin : 0;
        for (unsigned int s = packed.slot_begin[g]; s < packed.slot_end[g]; ++s)
          {
            const unsigned int p = s * group_size + i % group_size;
            const unsigned int k = begin + (s - packed.slot_begin[g]);
            packed.index[p]      = row;
            if (k >= begin + n)
              continue;
            packed.index[p] = list.index[k];
            packed.place[k] = p;
          }
      }
    pack([&](const unsigned int k) { return weight[k]; }, packed.weight);
    pack([&](const unsigned int k) { return dx[k]; }, packed.dx);
    pack([&](const unsigned int k) { return dy[k]; }, packed.dy);
  }


  void
  Bonds::make_breakable(const Kernel &kernel)
  {
    mirror.resize(list.index.size());
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        mirror[k] = find(list.index[k], i);
    pack(
        [&](const unsigned int k) {
          return weight[k] > 0. ? kernel.value(std::sqrt(length_square(k)))
                                : 0.;
        },
        packed.average);
  }


  void
  Bonds::cut(const unsigned int k)
  {
    for (const unsigned int entry : {k, mirror[k]})
      {
        const unsigned int p = packed.place[entry];
        live[entry]          = false;
        weight[entry]        = 0.;
        packed.weight[p]     = 0.;
        packed.average[p]    = 0.;
        if (!is_conforming())
          continue;
        own[entry] = back[entry] = {0., 0.};
        for (auto *values : {&packed.own_x,
                             &packed.own_y,
                             &packed.back_x,
                             &packed.back_y,
                             &packed.damping})
          (*values)[p] = 0.;
      }
  }


  long
  Bonds::find(const unsigned int i, const unsigned int j) const
  {
    const auto begin = list.index.begin() + list.start[i];
    const auto end   = list.index.begin() + list.start[i + 1];
    const auto place = std::lower_bound(begin, end, j);
    return place != end && *place == j ? place - list.index.begin() : -1;
  }


  Symmetric2
  Bonds::moment(const unsigned int i) const
  {
    Symmetric2 m{0., 0., 0.};
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        m.xx += weight[k] * dx[k] * dx[k];
        m.yy += weight[k] * dy[k] * dy[k];
        m.xy += weight[k] * dx[k] * dy[k];
      }
    return m;
  }


  Tensor2
  Bonds::gradient_moment(const unsigned int i) const
  {
    Tensor2 m{0., 0., 0., 0.};
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        m.xx += dx[k] * own[k].x;
        m.xy += dx[k] * own[k].y;
        m.yx += dy[k] * own[k].x;
        m.yy += dy[k] * own[k].y;
      }
    return m;
  }


  double
  Bonds::surface_measure(const unsigned int i,
                         const Particles   &particles,
                         const Kernel      &kernel) const
  {
    double x = 0., y = 0.;
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        const double w = particles.area[list.index[k]] *
                         kernel.gradient_weight(std::sqrt(length_square(k)));
        x += w * dx[k];
        y += w * dy[k];
      }
    return std::hypot(x, y);
  }


  double
  smaller_eigenvalue(const Symmetric2 &m)
  {
    return 0.5 * (m.xx + m.yy) - std::hypot(0.5 * (m.xx - m.yy), m.xy);
  }


  Symmetric2
  inverse(const Symmetric2 &m)
  {
    const double d = 1. / (m.xx * m.yy - m.xy * m.xy);
    return {d * m.yy, d * m.xx, -d * m.xy};
  }
} // namespace Morsel::SPH
