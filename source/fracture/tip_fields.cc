#include <morsel/fracture/tip_fields.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <cmath>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    /// sqrt(r) and the half-angle functions of a point in the tip's frame,
    /// without an arc tangent.
    struct HalfAngle
    {
      explicit HalfAngle(const Tensor<1, 2> &x)
          : r(x.norm())
          , root(std::sqrt(r))
      {
        Assert(r > 0., ExcMessage("Tip functions have no value at the tip."));
        cosine = x[0] / r;
        sine   = x[1] / r;
        // The larger half-angle function comes from the root, the other one
        // from sin t = 2 sin(t/2) cos(t/2): no cancellation near t = 0, pi.
        if (cosine > 0.)
          {
            c = std::sqrt(0.5 * (1. + cosine));
            s = 0.5 * sine / c;
          }
        else
          {
            s = std::copysign(std::sqrt(0.5 * (1. - cosine)), sine);
            c = 0.5 * sine / s;
          }
      }

      double r, root, cosine, sine;
      double c = 1.; ///< cos(t/2)
      double s = 0.; ///< sin(t/2)
    };


    /// d/dx_1 and d/dx_2 of sqrt(r) g(t), given g and g' = dg/dt.
    Tensor<1, 2>
    local_gradient(const HalfAngle &a, const double g, const double dg)
    {
      return Tensor<1, 2>({(0.5 * g * a.cosine - dg * a.sine) / a.root,
                           (0.5 * g * a.sine + dg * a.cosine) / a.root});
    }


    /// A vector given in the tip's frame, in global components.
    Tensor<1, 2>
    to_global(const CrackTip &tip, const Tensor<1, 2> &v)
    {
      const Tensor<1, 2> &d = tip.direction;
      return Tensor<1, 2>(
          {v[0] * d[0] - v[1] * d[1], v[0] * d[1] + v[1] * d[0]});
    }
  } // namespace


  std::array<ValueAndGradient, 4>
  tip_functions(const CrackTip &tip, const Point<2> &p)
  {
    const HalfAngle             a(tip.to_local(p));
    const std::array<double, 4> g  = {{a.s, a.c, a.s * a.sine, a.c * a.sine}};
    const std::array<double, 4> dg = {{0.5 * a.c,
                                       -0.5 * a.s,
                                       0.5 * a.c * a.sine + a.s * a.cosine,
                                       -0.5 * a.s * a.sine + a.c * a.cosine}};
    std::array<ValueAndGradient, 4> result;
    for (unsigned int k = 0; k < 4; ++k)
      {
        result[k].value    = a.root * g[k];
        result[k].gradient = to_global(tip, local_gradient(a, g[k], dg[k]));
      }
    return result;
  }


  DisplacementSample
  williams_field(const CrackTip     &tip,
                 const ElasticPlane &material,
                 const double        stress_intensity_I,
                 const double        stress_intensity_II,
                 const Point<2>     &p,
                 const bool          local_frame)
  {
    const HalfAngle a(tip.to_local(p));
    const double    k   = material.kappa;
    const double    c3  = a.cosine * a.c - a.sine * a.s; // cos(3t/2)
    const double    s3  = a.sine * a.c + a.cosine * a.s; // sin(3t/2)
    const double factor = 1. / (2. * material.mu * std::sqrt(2. * numbers::PI));
    const double K1     = factor * stress_intensity_I;
    const double K2     = factor * stress_intensity_II;

    const double g1 =
        K1 * ((k - 0.5) * a.c - 0.5 * c3) + K2 * ((k + 1.5) * a.s + 0.5 * s3);
    const double g2 =
        K1 * ((k + 0.5) * a.s - 0.5 * s3) - K2 * ((k - 1.5) * a.c + 0.5 * c3);
    const double dg1 = K1 * (-0.5 * (k - 0.5) * a.s + 0.75 * s3) +
                       K2 * (0.5 * (k + 1.5) * a.c + 0.75 * c3);
    const double dg2 = K1 * (0.5 * (k + 0.5) * a.c - 0.75 * c3) -
                       K2 * (-0.5 * (k - 1.5) * a.s - 0.75 * s3);

    DisplacementSample sample;
    sample.value       = Tensor<1, 2>({a.root * g1, a.root * g2});
    sample.gradient[0] = local_gradient(a, g1, dg1);
    sample.gradient[1] = local_gradient(a, g2, dg2);
    if (local_frame)
      return sample;

    Tensor<2, 2> frame; // columns: the tip's axes
    frame[0][0]     = tip.direction[0];
    frame[1][0]     = tip.direction[1];
    frame[0][1]     = -tip.direction[1];
    frame[1][1]     = tip.direction[0];
    sample.value    = frame * sample.value;
    sample.gradient = frame * sample.gradient * transpose(frame);
    return sample;
  }


  Tensor<2, 2>
  to_tip_frame(const CrackTip &tip, const Tensor<2, 2> &gradient)
  {
    Tensor<2, 2> frame;
    frame[0][0] = tip.direction[0];
    frame[1][0] = tip.direction[1];
    frame[0][1] = -tip.direction[1];
    frame[1][1] = tip.direction[0];
    return transpose(frame) * gradient * frame;
  }
} // namespace Morsel::Fracture
