#include <morsel/core/errors.h>
#include <morsel/fracture/interaction_integral.h>
#include <morsel/fracture/tip_fields.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    /// dq/dr of the step of degree nine from 1 to 0 between the ring's radii:
    /// smooth enough at both ends for Gauss rules on cells that it cuts.
    double
    weight_slope(const Ring &ring, const double r)
    {
      const double width = ring.outer_radius - ring.inner_radius;
      const double t     = (r - ring.inner_radius) / width;
      const double s     = t * (1. - t);
      return -630. * s * s * s * s / width;
    }
  } // namespace


  InteractionIntegral::InteractionIntegral(const CrackTip     &tip,
                                           const ElasticPlane &material,
                                           const Ring         &ring)
      : tip(tip)
      , material(material)
      , ring(ring)
  {
    Assert(0. <= ring.inner_radius && ring.inner_radius < ring.outer_radius,
           ExcMessage("A ring's outer radius exceeds its inner one."));
  }


  void
  InteractionIntegral::add(const Point<2>              &p,
                           const Tensor<2, 2>          &gradient,
                           const SymmetricTensor<2, 2> &stress,
                           const double                 weight)
  {
    if (!reaches(p))
      return;
    const Tensor<1, 2> x     = tip.to_local(p);
    const double       r     = x.norm();
    const Tensor<1, 2> dq    = weight_slope(ring, r) / r * x;
    const Tensor<2, 2> H     = to_tip_frame(tip, gradient);
    const Tensor<2, 2> sigma = to_tip_frame(tip, Tensor<2, 2>(stress));

    // (sigma_ij u_i,k - W delta_kj) q_,j with W = sigma:grad u / 2.
    Tensor<1, 2> traction_work = transpose(sigma) * dq;
    const double density       = 0.5 * scalar_product(sigma, H);
    energy_release += weight * (traction_work[0] * H[0][0] +
                                traction_work[1] * H[1][0] - density * dq[0]);
    energy_release_across +=
        weight * (traction_work[0] * H[0][1] + traction_work[1] * H[1][1] -
                  density * dq[1]);

    for (unsigned int mode = 0; mode < 2; ++mode)
      {
        const Tensor<2, 2> aux =
            williams_field(tip, material, mode == 0, mode == 1, p, true)
                .gradient;
        const Tensor<2, 2> sigma_aux(material.stress(aux));
        const Tensor<1, 2> aux_work = transpose(sigma_aux) * dq;
        double            &integral = mode == 0 ? integral_I : integral_II;
        integral += weight * (traction_work[0] * aux[0][0] +
                              traction_work[1] * aux[1][0] +
                              aux_work[0] * H[0][0] + aux_work[1] * H[1][0] -
                              scalar_product(sigma, aux) * dq[0]);
      }
  }


  double
  InteractionIntegral::ring_weight(const double distance) const
  {
    const double width = ring.outer_radius - ring.inner_radius;
    const double t = std::clamp((distance - ring.inner_radius) / width, 0., 1.);
    return 1. - t * t * t * t * t *
                    (126. - t * (420. - t * (540. - t * (315. - t * 70.))));
  }


  StressIntensity
  InteractionIntegral::stress_intensity() const
  {
    const double half = 0.5 * material.effective_modulus;
    return {half * integral_I, half * integral_II};
  }


  RingStatistics
  ring_statistics(const std::vector<StressIntensity> &rings)
  {
    Assert(!rings.empty(), ExcMessage("There is no ring."));
    RingStatistics  result;
    StressIntensity low = rings[0], high = rings[0];
    for (const StressIntensity &k : rings)
      {
        result.mean.mode_I += k.mode_I / rings.size();
        result.mean.mode_II += k.mode_II / rings.size();
        low.mode_I   = std::min(low.mode_I, k.mode_I);
        low.mode_II  = std::min(low.mode_II, k.mode_II);
        high.mode_I  = std::max(high.mode_I, k.mode_I);
        high.mode_II = std::max(high.mode_II, k.mode_II);
      }
    result.spread.mode_I  = high.mode_I - low.mode_I;
    result.spread.mode_II = high.mode_II - low.mode_II;
    return result;
  }


  double
  largest_ring_radius(const CrackTip           &tip,
                      const std::vector<Crack> &cracks,
                      const double              distance_to_boundary)
  {
    double radius = std::min(distance_to_boundary, tip.segment);
    for (unsigned int c = 0; c < cracks.size(); ++c)
      {
        const auto        &v = cracks[c].get_vertices();
        const unsigned int n = v.size() - 1;
        for (unsigned int s = 0; s < n; ++s)
          {
            const bool own_segment =
                c == tip.crack && s == (tip.end == 0 ? 0 : n - 1);
            if (!own_segment)
              radius = std::min(
                  radius, distance_to_segment(tip.position, v[s], v[s + 1]));
          }
      }
    return radius;
  }


  std::string
  ring_obstacle(const CrackTip           &tip,
                const std::vector<Crack> &cracks,
                const double              distance_to_boundary,
                const Ring               &ring)
  {
    const double limit = largest_ring_radius(tip, cracks, distance_to_boundary);
    if (ring.outer_radius <= limit)
      return "";
    std::ostringstream why;
    why << "its outer radius " << ring.outer_radius << " m reaches "
        << (limit == distance_to_boundary ? "the boundary of the body"
            : limit == tip.segment ? "the other end of the crack's segment"
                                   : "another crack")
        << ", which is " << limit << " m from the tip";
    return why.str();
  }


  void
  check_ring_radius(const CrackTip           &tip,
                    const std::vector<Crack> &cracks,
                    const double              distance_to_boundary,
                    const double              radius,
                    const std::string        &entry)
  {
    const std::string obstacle =
        ring_obstacle(tip, cracks, distance_to_boundary, {0., radius});
    if (obstacle.empty())
      return;
    std::ostringstream message;
    message << "'" << entry << "' is " << radius
            << " m, which does not fit at the crack tip (" << tip.position[0]
            << ", " << tip.position[1] << ") m: " << obstacle
            << ". Choose at most that, or 0 for the largest that fits.";
    throw InputError(message.str());
  }
} // namespace Morsel::Fracture
