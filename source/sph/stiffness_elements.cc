#include <morsel/sph/stiffness_elements.h>

namespace Morsel::SPH
{
  using dealii::Tensor;
  using dealii::Vector;

  StiffnessElements::StiffnessElements(const DiscreteGradient       &gradient,
                                       const ResidualControl        &control,
                                       const Fracture::ElasticPlane &material)
      : volume(gradient.volume)
      , lambda(material.lambda)
      , mu(material.mu)
  {
    const unsigned int        n       = volume.size();
    const unsigned int        nowhere = static_cast<unsigned int>(-1);
    std::vector<unsigned int> place(n, nowhere);
    for (unsigned int i = 0; i < n; ++i)
      {
        const std::size_t first    = nodes.index.size();
        const auto        entry_of = [&](const unsigned int j) -> Entry        &{
          if (place[j] == nowhere)
            {
              place[j] = nodes.index.size();
              nodes.index.push_back(j);
              entries.push_back({{0., 0.}, {0., 0.}, 0.});
            }
          return entries[place[j]];
        };
        entry_of(i);
        for (unsigned int k = gradient.list.start[i];
             k < gradient.list.start[i + 1];
             ++k)
          {
            const Tensor<1, 2> &g                     = gradient.weight[k];
            entry_of(gradient.list.index[k]).gradient = {g[0], g[1]};
            entries[first].gradient.x -= g[0];
            entries[first].gradient.y -= g[1];
          }
        for (unsigned int k = control.list.start[i];
             k < control.list.start[i + 1];
             ++k)
          {
            const double        stiffness = control.stiffness[k];
            const Tensor<1, 2> &X         = control.offset[k];
            Entry              &entry     = entry_of(control.list.index[k]);
            entry.stiffness               = stiffness;
            entry.moment = {stiffness * X[0], stiffness * X[1]};
            Entry &own   = entries[first];
            own.stiffness += stiffness;
            own.moment.x -= entry.moment.x;
            own.moment.y -= entry.moment.y;
          }
        nodes.start.push_back(nodes.index.size());
        for (std::size_t k = first; k < nodes.index.size(); ++k)
          place[nodes.index[k]] = nowhere;
        const Tensor<2, 2> &m = control.inverse_moment[i];
        inverse_moment.push_back({m[0][0], m[1][1], m[0][1]});
      }
  }


  void
  StiffnessElements::matrix(const unsigned int   i,
                            std::vector<double> &result) const
  {
    const Entry       *entry = &entries[nodes.start[i]];
    const unsigned int n     = nodes.start[i + 1] - nodes.start[i];
    const Symmetric2  &m     = inverse_moment[i];
    for (unsigned int b = 0; b < n; ++b)
      {
        const Vector2 &g = entry[b].gradient, &p = entry[b].moment;
        // lambda g_a (x) g_b + mu (g_b (x) g_a + g_a.g_b I), V_i included.
        const double  lx = volume[i] * lambda * g.x;
        const double  ly = volume[i] * lambda * g.y;
        const double  mx = volume[i] * mu * g.x;
        const double  my = volume[i] * mu * g.y;
        const Vector2 fit{0.5 * (m.xx * p.x + m.xy * p.y),
                          0.5 * (m.xy * p.x + m.yy * p.y)};
        for (unsigned int a = b; a < n; ++a)
          {
            const Vector2 &h        = entry[a].gradient;
            const double   diagonal = h.x * mx + h.y * my -
                                    entry[a].moment.x * fit.x -
                                    entry[a].moment.y * fit.y;
            double *first  = &result[2 * b * 2 * n + 2 * a];
            double *second = first + 2 * n;
            first[0]       = h.x * (lx + mx) + diagonal;
            first[1]       = h.y * lx + h.x * my;
            second[0]      = h.x * ly + h.y * mx;
            second[1]      = h.y * (ly + my) + diagonal;
          }
      }
    // Springs between the particle and its neighbours.
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const unsigned int row  = 2 * a + d;
          const double       half = 0.5 * entry[a].stiffness;
          result[row * 2 * n + row] += half;
          if (a > 0)
            result[d * 2 * n + row] -= half;
        }
  }


  void
  StiffnessElements::vmult(Vector<double> &y, const Vector<double> &x) const
  {
    y               = 0.;
    const double *u = x.begin();
    double       *f = y.begin();
    for (unsigned int i = 0; i < volume.size(); ++i)
      {
        const unsigned int begin = nodes.start[i], end = nodes.start[i + 1];
        const double       u_x = u[2 * i], u_y = u[2 * i + 1];
        Tensor2            H{0., 0., 0., 0.}, P{0., 0., 0., 0.};
        for (unsigned int k = begin + 1; k < end; ++k)
          {
            const Entry       &entry = entries[k];
            const unsigned int j     = nodes.index[k];
            const double       d_x = u[2 * j] - u_x, d_y = u[2 * j + 1] - u_y;
            H.xx += d_x * entry.gradient.x;
            H.xy += d_x * entry.gradient.y;
            H.yx += d_y * entry.gradient.x;
            H.yy += d_y * entry.gradient.y;
            P.xx += d_x * entry.moment.x;
            P.xy += d_x * entry.moment.y;
            P.yx += d_y * entry.moment.x;
            P.yy += d_y * entry.moment.y;
          }
        const double V        = volume[i];
        const double pressure = V * lambda * (H.xx + H.yy);
        const double s_xx     = pressure + 2. * V * mu * H.xx;
        const double s_yy     = pressure + 2. * V * mu * H.yy;
        const double s_xy     = V * mu * (H.xy + H.yx);
        Symmetric2   half     = inverse_moment[i];
        half.xx *= 0.5;
        half.xy *= 0.5;
        half.yy *= 0.5;
        const Tensor2 A   = product(P, half);
        double        f_x = 0., f_y = 0.;
        for (unsigned int k = begin + 1; k < end; ++k)
          {
            const Entry       &entry = entries[k];
            const unsigned int j     = nodes.index[k];
            const double       d_x = u[2 * j] - u_x, d_y = u[2 * j + 1] - u_y;
            const double       spring = 0.5 * entry.stiffness;
            const double x = s_xx * entry.gradient.x + s_xy * entry.gradient.y +
                             spring * d_x - A.xx * entry.moment.x -
                             A.xy * entry.moment.y;
            const double y = s_xy * entry.gradient.x + s_yy * entry.gradient.y +
                             spring * d_y - A.yx * entry.moment.x -
                             A.yy * entry.moment.y;
            f[2 * j] += x;
            f[2 * j + 1] += y;
            f_x += x;
            f_y += y;
          }
        f[2 * i] -= f_x;
        f[2 * i + 1] -= f_y;
      }
  }
} // namespace Morsel::SPH
