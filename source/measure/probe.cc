#include <morsel/core/kernel.h>
#include <morsel/measure/probe.h>

#include <deal.II/base/tensor.h>

namespace Morsel::Measure
{
  Probe::Probe(const SPH::Particles &p, const dealii::Point<2> &point)
  {
    // On an edge of a lattice the support must hold three rows.
    const Kernel         kernel(KernelKind::wendland_c2, 1.4 * p.spacing);
    dealii::Tensor<2, 3> moment;
    const auto           basis = [&](const unsigned int i) {
      dealii::Tensor<1, 3> b;
      b[0] = 1.;
      b[1] = (p.reference[i][0] - point[0]) / p.spacing;
      b[2] = (p.reference[i][1] - point[1]) / p.spacing;
      return b;
    };
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const double w = kernel.value((p.reference[i] - point).norm());
        if (w == 0.)
          continue;
        weights.push_back({i, w});
        moment += w * outer_product(basis(i), basis(i));
      }
    const dealii::Tensor<2, 3> inverse = invert(moment);
    for (Weight &w : weights)
      w.value *= (inverse * basis(w.particle))[0];
  }


  template <typename Value>
  Vector2
  Probe::sum(const Value &value) const
  {
    Vector2 s{0., 0.};
    for (const Weight &w : weights)
      {
        const Vector2 v = value(w.particle);
        s.x += w.value * v.x;
        s.y += w.value * v.y;
      }
    return s;
  }


  Vector2
  Probe::displacement(const SPH::Particles &p) const
  {
    return sum([&](const unsigned int i) {
      return Vector2{p.motion[i].u_x, p.motion[i].u_y};
    });
  }


  Vector2
  Probe::velocity(const SPH::Particles &p) const
  {
    return sum([&](const unsigned int i) {
      return Vector2{p.motion[i].v_x, p.motion[i].v_y};
    });
  }


  Materials::PlaneStrainStress
  Probe::stress(const SPH::DeformableBody &body) const
  {
    Materials::PlaneStrainStress s{0., 0., 0., 0.};
    for (const Weight &w : weights)
      {
        const auto t = body.stress(w.particle);
        s.xx += w.value * t.xx;
        s.yy += w.value * t.yy;
        s.xy += w.value * t.xy;
        s.zz += w.value * t.zz;
      }
    return s;
  }


  void
  Passages::add(const double time, const double value)
  {
    if (value == 0.)
      return;
    if (begun && value * last_value < 0.)
      {
        last =
            last_time + (time - last_time) * last_value / (last_value - value);
        if (count++ == 0)
          first = last;
      }
    begun      = true;
    last_time  = time;
    last_value = value;
  }
} // namespace Morsel::Measure
