#include <morsel/sph/bonds.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  void
  Bonds::build(const Particles   &particles,
               const Kernel      &kernel,
               const Visibility  &visibility,
               const BondOptions &options)
  {
    list =
        find_neighbours(particles.reference,
                        options.breaks ? particles.n_local : particles.n_owned,
                        kernel.support());
    keep_visible(list, particles.reference, visibility);
    weight.resize(list.index.size());
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        weight[k] =
            particles.area[list.index[k]] *
            kernel.gradient_weight(std::sqrt(length_square(particles, i, k)));
    if (options.breaks)
      live.assign(weight.size(), true);
    if (options.search_lattice)
      lattice.find(particles, *this, options.first_without_ghosts);
    pack(particles, particles.n_owned, options.breaks);
    if (!options.breaks)
      packed.place = std::vector<unsigned int>();
  }


  void
  Bonds::pack(const Particles   &particles,
              const unsigned int n_rows,
              const bool         all)
  {
    const unsigned int n_groups = (n_rows + group_size - 1) / group_size;
    packed.slot_begin.assign(1, 0);
    for (unsigned int g = 0; g < n_groups; ++g)
      {
        unsigned int longest = 0, most_near = 0;
        for (unsigned int i = g * group_size;
             (all || !lattice.is_regular(g)) &&
             i < std::min(n_rows, (g + 1) * group_size);
             ++i)
          {
            longest   = std::max(longest, list.start[i + 1] - list.start[i]);
            most_near = std::max(most_near, n_near(i));
          }
        packed.near_end.push_back(packed.slot_begin.back() + most_near);
        packed.slot_begin.push_back(packed.slot_begin.back() + longest);
      }
    packed.slot_end.assign(packed.slot_begin.begin() + 1,
                           packed.slot_begin.end());

    // What is left of a group's slots are pairs of a particle with itself.
    packed.index.resize(packed.slot_begin.back() * group_size);
    packed.place.assign(list.start[n_rows], nowhere);
    for (unsigned int i = 0; i < n_groups * group_size; ++i)
      {
        const unsigned int g   = i / group_size;
        const unsigned int row = std::min(i, n_rows - 1);
        for (unsigned int s = packed.slot_begin[g]; s < packed.slot_end[g]; ++s)
          packed.index[s * group_size + i % group_size] = row;
        if (i >= n_rows || (!all && lattice.is_regular(g)))
          continue;
        unsigned int near = packed.slot_begin[g];
        unsigned int far  = near + n_near(i);
        for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
          {
            const unsigned int s          = weight[k] > 0. ? near++ : far++;
            packed.place[k]               = s * group_size + i % group_size;
            packed.index[packed.place[k]] = list.index[k];
          }
      }
    const auto offset_of = [&](const unsigned int i, const unsigned int k) {
      return lattice.adjusted(offset(particles, i, k), *this, i, k);
    };
    pack([&](unsigned int, const unsigned int k) { return weight[k]; },
         packed.weight);
    if (is_conforming())
      return;
    pack([&](const unsigned int i,
             const unsigned int k) { return offset_of(i, k).x; },
         packed.dx);
    pack([&](const unsigned int i,
             const unsigned int k) { return offset_of(i, k).y; },
         packed.dy);
  }


  unsigned int
  Bonds::n_near(const unsigned int i) const
  {
    return std::count_if(weight.begin() + list.start[i],
                         weight.begin() + list.start[i + 1],
                         [](const double w) { return w > 0.; });
  }


  void
  Bonds::make_breakable(const Particles &particles, const Kernel &kernel)
  {
    mirror.resize(list.index.size());
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        mirror[k] = find(list.index[k], i);
    pack(
        [&](const unsigned int i, const unsigned int k) {
          return weight[k] > 0.
                     ? kernel.value(std::sqrt(length_square(particles, i, k)))
                     : 0.;
        },
        packed.average);
  }


  void
  Bonds::cut(const unsigned int k)
  {
    for (const unsigned int entry : {k, mirror[k]})
      {
        live[entry]   = false;
        weight[entry] = 0.;
        if (entry >= n_packed())
          continue; // of a ghost
        const unsigned int p = packed.place[entry];
        lattice.leave(row_of(entry), list);
        packed.weight[p]  = 0.;
        packed.average[p] = 0.;
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


  unsigned int
  Bonds::row_of(const unsigned int entry) const
  {
    return std::upper_bound(list.start.begin(), list.start.end(), entry) -
           list.start.begin() - 1;
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
  Bonds::moment(const Particles &particles, const unsigned int i) const
  {
    Symmetric2 m{0., 0., 0.};
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        const Vector2 X = offset(particles, i, k);
        m.xx += weight[k] * X.x * X.x;
        m.yy += weight[k] * X.y * X.y;
        m.xy += weight[k] * X.x * X.y;
      }
    return m;
  }


  Tensor2
  Bonds::gradient_moment(const Particles &particles, const unsigned int i) const
  {
    Tensor2 m{0., 0., 0., 0.};
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        const Vector2 X = offset(particles, i, k);
        m.xx += X.x * own[k].x;
        m.xy += X.x * own[k].y;
        m.yx += X.y * own[k].x;
        m.yy += X.y * own[k].y;
      }
    return m;
  }


  Vector2
  Bonds::gradient_sum(const unsigned int i) const
  {
    Vector2 sum{0., 0.};
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        sum.x += own[k].x;
        sum.y += own[k].y;
      }
    return sum;
  }


  double
  Bonds::surface_measure(const unsigned int i,
                         const Particles   &particles,
                         const Kernel      &kernel) const
  {
    double x = 0., y = 0.;
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        const Vector2 X = offset(particles, i, k);
        const double  w = particles.area[list.index[k]] *
                         kernel.gradient_weight(std::hypot(X.x, X.y));
        x += w * X.x;
        y += w * X.y;
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
