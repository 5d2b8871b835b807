#include <morsel/core/errors.h>
#include <morsel/sph/tip_sampling.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <sstream>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;

  TipResult
  choose_rings(const Cloud                        &cloud,
               const std::vector<Fracture::Crack> &cracks,
               const Fracture::CrackTip           &tip,
               const double                        radius)
  {
    const double      depth = std::min({tip.position[0] - cloud.lower[0],
                                        cloud.upper[0] - tip.position[0],
                                        tip.position[1] - cloud.lower[1],
                                        cloud.upper[1] - tip.position[1]});
    const double      limit = Fracture::largest_ring_radius(tip, cracks, depth);
    const double      largest = radius > 0. ? radius : 0.95 * limit;
    const std::string obstacle =
        Fracture::ring_obstacle(tip, cracks, depth, {0., largest});
    if (!obstacle.empty())
      {
        std::ostringstream message;
        message << "The ring of radius " << largest
                << " m for the stress intensity at the crack tip ("
                << tip.position << ") m does not fit: " << obstacle
                << ". Choose a radius below that, or 0 for the largest that "
                   "fits.";
        throw InputError(message.str());
      }
    TipResult result;
    for (const double share : {0.6, 0.8, 1.})
      result.rings.push_back({0.3 * share * largest, share * largest});
    if (largest < 5. * cloud.spacing)
      {
        std::ostringstream remark;
        remark << "The rings at the tip (" << tip.position << ") m are only "
               << largest / cloud.spacing
               << " particles wide: give more particles.";
        result.remark = remark.str();
      }
    return result;
  }


  void
  evaluate_rings(const ShapeFunctions         &shape,
                 const TensorField            &gradients,
                 const Fracture::ElasticPlane &material,
                 const Fracture::CrackTip     &tip,
                 TipResult                    &result)
  {
    std::vector<Fracture::InteractionIntegral> integrals;
    double inside = result.rings[0].inner_radius, reach = 0.;
    for (const Fracture::Ring &ring : result.rings)
      {
        integrals.emplace_back(tip, material, ring);
        inside = std::min(inside, ring.inner_radius);
        reach  = std::max(reach, ring.outer_radius);
      }

    // Two Gauss points per half spacing along radius and circle. Angles
    // begin and end on the crack, so that no interval straddles it.
    const double            step = 0.5 * shape.get_cloud().spacing;
    const double            turn = 2. * dealii::numbers::PI;
    const unsigned int      n_r  = std::ceil((reach - inside) / step);
    const unsigned int      n_t  = std::ceil(turn * reach / step);
    const double            dr = (reach - inside) / n_r, dt = turn / n_t;
    const dealii::QGauss<1> gauss(2);
    ShapeValues             values;
    for (unsigned int i = 0; i < n_r * gauss.size(); ++i)
      for (unsigned int j = 0; j < n_t * gauss.size(); ++j)
        {
          const unsigned int a = i % gauss.size(), b = j % gauss.size();
          const double r = inside + (i / gauss.size() + gauss.point(a)[0]) * dr;
          const double t =
              -0.5 * turn + (j / gauss.size() + gauss.point(b)[0]) * dt;
          const double   c = std::cos(t), s = std::sin(t);
          const Point<2> x =
              tip.position +
              r * Tensor<1, 2>({c * tip.direction[0] - s * tip.direction[1],
                                c * tip.direction[1] + s * tip.direction[0]});
          shape.evaluate(x, x, values);
          Tensor<2, 2> H;
          for (unsigned int k = 0; k < values.index.size(); ++k)
            H += values.value[k] * gradients[values.index[k]];
          for (auto &integral : integrals)
            integral.add(x,
                         H,
                         material.stress(H),
                         r * dr * dt * gauss.weight(a) * gauss.weight(b));
        }

    result.by_ring.clear();
    result.energy_release.clear();
    for (const auto &integral : integrals)
      {
        result.by_ring.push_back(integral.stress_intensity());
        result.energy_release.push_back(integral.energy_release_rate());
      }
    result.statistics = Fracture::ring_statistics(result.by_ring);
  }
} // namespace Morsel::SPH
