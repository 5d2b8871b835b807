#include <morsel/measure/particle_field.h>
#include <morsel/sph/neighbours.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Measure
{
  namespace
  {
    /// Whether the support of a particle, @p support spacings wide, ends within
    /// the body, with @p rows further rows up to the edge.
    bool
    has_full_support(const unsigned int rows, const double support)
    {
      return rows + 1. >= support * (1. - 1e-9);
    }
  } // namespace


  double
  smallest_spacing(const SPH::Particles &p)
  {
    std::vector<dealii::Point<2>> points(p.n_owned);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      points[i] = p.position(i);
    constexpr double reach = 2.;
    SPH::CellGrid    grid;
    grid.build(points, reach * p.spacing);
    double least = reach * reach * p.spacing * p.spacing;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      grid.for_each_near(points[i], [&](const unsigned int j) {
        if (j > i)
          least = std::min(least, (points[j] - points[i]).norm_square());
      });
    return std::sqrt(least) / p.spacing;
  }


  Noise
  stress_noise(const SPH::DeformableBody &body, const unsigned int nx)
  {
    const unsigned int                        n = body.get_particles().n_owned;
    std::vector<Materials::PlaneStrainStress> s(n);
    for (unsigned int i = 0; i < n; ++i)
      s[i] = body.stress(i);
    const auto noise = [&](double Materials::PlaneStrainStress::*component) {
      double rough = 0., whole = 0.;
      for (unsigned int i = nx; i + nx < n; ++i)
        {
          if (i % nx == 0 || i % nx == nx - 1)
            continue;
          const auto  &t   = s[i];
          const double own = t.*component;
          const double mean =
              0.25 * (s[i - 1].*component + s[i + 1].*component +
                      s[i - nx].*component + s[i + nx].*component);
          rough += (own - mean) * (own - mean);
          whole += t.xx * t.xx + t.yy * t.yy + 2. * t.xy * t.xy;
        }
      return whole > 0. ? std::sqrt(rough / whole) : 0.;
    };
    return {noise(&Materials::PlaneStrainStress::xx),
            noise(&Materials::PlaneStrainStress::yy)};
  }


  InteriorStress
  interior_stress(const SPH::DeformableBody &body,
                  const Scene::ParticleBody &shape,
                  const double               support)
  {
    const SPH::Particles &p  = body.get_particles();
    const unsigned int    nx = shape.particles_across;
    const unsigned int    ny = shape.particles_high();
    InteriorStress        result;
    const auto            each = [&](const auto &f) {
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const unsigned int row = std::min(i / nx, ny - 1 - i / nx);
          const unsigned int column = std::min(i % nx, nx - 1 - i % nx);
          if (has_full_support(std::min(row, column), support / p.spacing))
            f(body.stress(i));
        }
    };
    each([&](const Materials::PlaneStrainStress &s) {
      ++result.count;
      result.mean_xx += s.xx;
      result.mean_yy += s.yy;
    });
    if (result.count == 0)
      return result;
    result.mean_xx /= result.count;
    result.mean_yy /= result.count;
    each([&](const Materials::PlaneStrainStress &s) {
      const double dx = s.xx - result.mean_xx, dy = s.yy - result.mean_yy;
      result.deviation_xx += dx * dx / result.count;
      result.deviation_yy += dy * dy / result.count;
    });
    result.deviation_xx = std::sqrt(result.deviation_xx);
    result.deviation_yy = std::sqrt(result.deviation_yy);
    return result;
  }


  double
  velocity_roughness(const SPH::Particles &p, const unsigned int nx)
  {
    double       sum = 0.;
    unsigned int n   = 0;
    for (unsigned int i = nx; i + nx < p.n_owned; ++i)
      {
        if (i % nx == 0 || i % nx == nx - 1)
          continue;
        const auto difference = [&](double Motion::*component) {
          const auto v = [&](const unsigned int j) {
            return p.motion[j].*component;
          };
          return v(i) - 0.25 * (v(i - 1) + v(i + 1) + v(i - nx) + v(i + nx));
        };
        const double x = difference(&Motion::v_x);
        const double y = difference(&Motion::v_y);
        sum += x * x + y * y;
        ++n;
      }
    return n > 0 ? std::sqrt(sum / n) : 0.;
  }


  GradientErrors
  strain_rate_errors(const SPH::DeformableBody &body,
                     const Scene::ParticleBody &shape,
                     const double               support,
                     const Tensor2             &expected)
  {
    GradientErrors        errors{0., 0., 0.};
    const SPH::Particles &p     = body.get_particles();
    const unsigned int    nx    = shape.particles_across;
    const unsigned int    ny    = shape.particles_high();
    const double          ratio = support / p.spacing;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const unsigned int a     = std::min(i % nx, nx - 1 - i % nx);
        const unsigned int b     = std::min(i / nx, ny - 1 - i / nx);
        const auto [least, most] = std::minmax(a, b);
        const auto   L           = body.velocity_gradient(i);
        const double error =
            std::max({std::abs(L.xx - expected.xx),
                      std::abs(L.yy - expected.yy),
                      0.5 * std::abs(L.xy + L.yx - expected.xy - expected.yx)});
        if (most == 0)
          errors.corner = std::max(errors.corner, error);
        else if (least == 0 && has_full_support(most, ratio))
          errors.edge = std::max(errors.edge, error);
        else if (has_full_support(least, ratio))
          errors.interior = std::max(errors.interior, error);
      }
    return errors;
  }
} // namespace Morsel::Measure
