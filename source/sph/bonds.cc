#include <morsel/sph/bonds.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  void
  Bonds::build(const Particles &particles, const Kernel &kernel)
  {
    list = find_neighbours(
        particles.reference, particles.n_owned, kernel.support());
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
  }


  void
  Bonds::find_mirrors()
  {
    mirror.resize(list.index.size());
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        mirror[k] = find(list.index[k], i);
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
