#include <morsel/core/kernel.h>
#include <morsel/measure/probe.h>
#include <morsel/sph/host.h>

#include <deal.II/base/tensor.h>

namespace Morsel::Measure
{
  Probe::Probe(const SPH::DeformableBody &body, const dealii::Point<2> &point)
      : body(&body)
  {
    const SPH::Particles &p = body.get_particles();
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
    if (body.ranks())
      moment =
          dealii::Utilities::MPI::sum(moment, body.ranks()->communicator());
    const dealii::Tensor<2, 3> inverse = invert(moment);
    for (Weight &w : weights)
      w.value *= (inverse * basis(w.particle))[0];
  }


  template <typename Value>
  Vector2
  Probe::sum(const Value &value) const
  {
    double s[2] = {0., 0.};
    for (const Weight &w : weights)
      {
        const Vector2 v = value(w.particle);
        s[0] += w.value * v.x;
        s[1] += w.value * v.y;
      }
    body->sum_over_ranks(dealii::make_array_view(s));
    return {s[0], s[1]};
  }


  Vector2
  Probe::displacement() const
  {
    const auto &motion = body->get_particles().motion;
    return sum([&](const unsigned int i) {
      return Vector2{motion[i].u_x, motion[i].u_y};
    });
  }


  Vector2
  Probe::velocity() const
  {
    const auto &motion = body->get_particles().motion;
    return sum([&](const unsigned int i) {
      return Vector2{motion[i].v_x, motion[i].v_y};
    });
  }


  Materials::PlaneStrainStress
  Probe::stress() const
  {
    double s[4] = {0., 0., 0., 0.};
    for (const Weight &w : weights)
      {
        const auto t = body->stress(w.particle);
        s[0] += w.value * t.xx;
        s[1] += w.value * t.yy;
        s[2] += w.value * t.xy;
        s[3] += w.value * t.zz;
      }
    body->sum_over_ranks(dealii::make_array_view(s));
    return {s[0], s[1], s[2], s[3]};
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
