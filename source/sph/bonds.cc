#include <morsel/sph/bonds.h>
#include <morsel/sph/visibility.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  void
  Bonds::build(const Particles                    &particles,
               const Kernel                       &kernel,
               const std::vector<Fracture::Crack> &cracks)
  {
    list = find_neighbours(
        particles.reference, particles.n_owned, kernel.support());
    keep_visible(list,
                 particles.reference,
                 {cracks, TipHandling::visibility, kernel.support()});
    const unsigned int n = list.index.size();
    weight.resize(n);
    dx.resize(n);
    dy.resize(n);
    const double area =
        particles.spacing * particles.spacing; // V_j per unit depth
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        {
          const auto X =
              particles.reference[list.index[k]] - particles.reference[i];
          dx[k]     = X[0];
          dy[k]     = X[1];
          weight[k] = area * kernel.gradient_weight(X.norm());
        }
    pack();
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
    packed.weight.resize(size, 0.);
    packed.dx.resize(size, 0.);
    packed.dy.resize(size, 0.);
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
            packed.weight[p] = weight[k];
            packed.dx[p]     = dx[k];
            packed.dy[p]     = dy[k];
            packed.index[p]  = list.index[k];
            packed.place[k]  = p;
          }
      }
  }


  void
  Bonds::make_breakable(const Kernel &kernel)
  {
    mirror.resize(list.index.size());
    packed.average.resize(packed.weight.size(), 0.);
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        {
          mirror[k] = find(list.index[k], i);
          packed.average[packed.place[k]] =
              kernel.value(std::sqrt(length_square(k)));
        }
  }


  void
  Bonds::cut(const unsigned int k)
  {
    for (const unsigned int entry : {k, mirror[k]})
      {
        weight[entry]                       = 0.;
        packed.weight[packed.place[entry]]  = 0.;
        packed.average[packed.place[entry]] = 0.;
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


  double
  Bonds::surface_measure(const unsigned int i) const
  {
    double x = 0., y = 0.;
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        x += weight[k] * dx[k];
        y += weight[k] * dy[k];
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
