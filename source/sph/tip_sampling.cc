#include <morsel/sph/tip_sampling.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <sstream>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Places about a tip with the weight that each has in an integral.
    struct Places
    {
      std::vector<Point<2>> points;
      std::vector<double>   weights;   ///< [m^2], or [m] along a line
      std::vector<double>   distances; ///< to the tip [m]
    };


    /// Two Gauss points per @p step along radius and circle. Angles begin and
    /// end on the crack, so that no interval straddles it.
    Places
    ring_places(const Fracture::CrackTip &tip,
                const double              inside,
                const double              reach,
                const double              step)
    {
      const double            turn = 2. * dealii::numbers::PI;
      const unsigned int      n_r  = std::ceil((reach - inside) / step);
      const unsigned int      n_t  = std::ceil(turn * reach / step);
      const double            dr = (reach - inside) / n_r, dt = turn / n_t;
      const dealii::QGauss<1> gauss(2);
      Places                  places;
      for (unsigned int i = 0; i < n_r * gauss.size(); ++i)
        for (unsigned int j = 0; j < n_t * gauss.size(); ++j)
          {
            const unsigned int a = i % gauss.size(), b = j % gauss.size();
            const double       r =
                inside + (i / gauss.size() + gauss.point(a)[0]) * dr;
            const double t =
                -0.5 * turn + (j / gauss.size() + gauss.point(b)[0]) * dt;
            const Tensor<1, 2> &d = tip.direction;
            const double        c = std::cos(t), s = std::sin(t);
            places.points.push_back(
                tip.position +
                r * Tensor<1, 2>({c * d[0] - s * d[1], c * d[1] + s * d[0]}));
            places.weights.push_back(r * dr * dt * gauss.weight(a) *
                                     gauss.weight(b));
            places.distances.push_back(r);
          }
      return places;
    }


    /// Along the crack's left face and then its right one, a small angle off
    /// it; the energies there differ like r^(-1/2), so Gauss points stand in
    /// the root of the distance.
    Places
    face_places(const Fracture::CrackTip &tip, const double reach)
    {
      constexpr unsigned int  n_intervals = 16;
      const dealii::QGauss<1> gauss(6);
      const Tensor<1, 2>      normal({-tip.direction[1], tip.direction[0]});
      Places                  places;
      for (const double side : {1., -1.})
        for (unsigned int k = 0; k < n_intervals; ++k)
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const double t = (k + gauss.point(q)[0]) / n_intervals;
              places.distances.push_back(reach * t * t);
              places.weights.push_back(2. * reach * t * gauss.weight(q) /
                                       n_intervals);
              places.points.push_back(tip.position -
                                      reach * t * t * tip.direction +
                                      side * 1e-6 * reach * t * t * normal);
            }
      return places;
    }
  } // namespace


  Fracture::TipResult
  choose_rings(const Cloud                        &cloud,
               const std::vector<Fracture::Crack> &cracks,
               const Fracture::CrackTip           &tip,
               const double                        radius)
  {
    const double depth = std::min({tip.position[0] - cloud.lower[0],
                                   cloud.upper[0] - tip.position[0],
                                   tip.position[1] - cloud.lower[1],
                                   cloud.upper[1] - tip.position[1]});
    Fracture::check_ring_radius(tip, cracks, depth, radius);
    const double largest =
        radius > 0. ? radius
                    : 0.95 * Fracture::largest_ring_radius(tip, cracks, depth);
    Fracture::TipResult result;
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
  evaluate_rings(const Fracture::FieldSampler &sample,
                 const Fracture::ElasticPlane &material,
                 const Fracture::CrackTip     &tip,
                 const double                  spacing,
                 const bool                    both_components,
                 Fracture::TipResult          &result)
  {
    std::vector<Fracture::InteractionIntegral> integrals;
    double inside = result.rings[0].inner_radius, reach = 0.;
    for (const Fracture::Ring &ring : result.rings)
      {
        integrals.emplace_back(tip, material, ring);
        inside = std::min(inside, ring.inner_radius);
        reach  = std::max(reach, ring.outer_radius);
      }
    const Places ring    = ring_places(tip, inside, reach, 0.5 * spacing);
    const auto   samples = sample(ring.points);
    for (unsigned int i = 0; i < samples.size(); ++i)
      for (auto &integral : integrals)
        integral.add(ring.points[i],
                     samples[i].gradient,
                     material.stress(samples[i].gradient),
                     ring.weights[i]);
    if (both_components)
      {
        const Places faces  = face_places(tip, reach);
        const auto   values = sample(faces.points);
        const auto   energy = [&](const unsigned int i) {
          const Tensor<2, 2> &H = values[i].gradient;
          return 0.5 * scalar_product(Tensor<2, 2>(material.stress(H)), H);
        };
        const unsigned int n = values.size() / 2;
        for (unsigned int i = 0; i < n; ++i)
          for (auto &integral : integrals)
            integral.add_faces(faces.distances[i],
                               energy(i) - energy(n + i),
                               faces.weights[i]);
      }

    result.by_ring.clear();
    result.energy_release.clear();
    result.energy_release_across.clear();
    for (const auto &integral : integrals)
      {
        result.by_ring.push_back(integral.stress_intensity());
        result.energy_release.push_back(integral.energy_release_rate());
        if (both_components)
          result.energy_release_across.push_back(
              integral.energy_release_rate_across());
      }
    result.statistics = Fracture::ring_statistics(result.by_ring);
  }


  Fracture::DisplacementSample
  CloudField::sample_from(const Point<2> &eye, const Point<2> &x) const
  {
    ShapeValues values;
    shape.evaluate(eye, x, values);
    Fracture::DisplacementSample sample;
    for (unsigned int k = 0; k < values.index.size(); ++k)
      {
        sample.value += values.value[k] * displacement[values.index[k]];
        sample.gradient += values.value[k] * gradients[values.index[k]];
      }
    return sample;
  }


  std::vector<Fracture::DisplacementSample>
  CloudField::sample(const std::vector<Point<2>> &points) const
  {
    std::vector<Fracture::DisplacementSample> samples;
    for (const Point<2> &p : points)
      samples.push_back(sample_from(p, p));
    return samples;
  }


  std::vector<Fracture::TipResult>
  evaluate_tips(const CloudField                   &field,
                const std::vector<Fracture::Crack> &cracks,
                const Fracture::ElasticPlane       &material,
                const double                        ring_radius,
                const bool                          both_components)
  {
    const Cloud                     &cloud = field.shape.get_cloud();
    std::vector<Fracture::TipResult> results;
    for (const Fracture::CrackTip &tip : Fracture::collect_tips(cracks))
      {
        Fracture::TipResult result =
            choose_rings(cloud, cracks, tip, ring_radius);
        result.tip = results.size();
        evaluate_rings(
            [&](const std::vector<Point<2>> &points) {
              return field.sample(points);
            },
            material,
            tip,
            cloud.spacing,
            both_components,
            result);
        results.push_back(result);
      }
    return results;
  }
} // namespace Morsel::SPH
