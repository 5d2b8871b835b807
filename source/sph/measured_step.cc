#include <morsel/sph/highest_frequency.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/stable_step.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// Of the square of the frequency: 1 % of the step.
    constexpr double tolerance = 0.02;
  } // namespace


  double
  Solid::measured_stable_time_step(const double contact_stiffness,
                                   const double stopped)
  {
    const unsigned int n = particles.n_owned;
    // Small enough for the tangent, large enough for its round-off.
    const double              size = 1e-6 * particles.spacing;
    const std::vector<double> mass(particles.mass.begin(),
                                   particles.mass.begin() + n);
    std::vector<double>       springs(n, 0.); // over mass [1/s^2]
    for (unsigned int i = 0; i < n; ++i)
      if (bonds.on_surface(i, particles, kernel))
        springs[i] = contact_stiffness / mass[i];

    const auto accelerations = [&](const std::vector<Vector2> &u,
                                   std::vector<Vector2>       &a) {
      double largest = 0.;
      for (const Vector2 &v : u)
        largest = std::max({largest, std::abs(v.x), std::abs(v.y)});
      const double scale = size / -host.minimum(-largest);
      for (unsigned int i = 0; i < n; ++i)
        particles.motion[i] = {scale * u[i].x, scale * u[i].y, 0., 0.};
      host.exchange_start(dealii::make_array_view(particles.motion),
                          motion_channel);
      motion_travels = true;
      compute_accelerations(0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          const Vector2 &now = particles.acceleration[i];
          a[i]               = {now.x / scale - springs[i] * u[i].x,
                                now.y / scale - springs[i] * u[i].y};
        }
    };
    const double w2 = square_of_highest_frequency(
        accelerations,
        random_field({particles.id.begin(), particles.id.begin() + n}),
        mass,
        tolerance,
        [this](const double mine) { return host.sum(mine); });

    for (unsigned int i = 0; i < particles.n_local; ++i)
      {
        const Vector2 &v    = particles.half_velocity[i];
        particles.motion[i] = {0., 0., v.x, v.y};
      }
    particles.gradient.assign(particles.gradient.size(), {0., 0., 0., 0.});
    particles.pair_stress.assign(particles.pair_stress.size(),
                                 {0., 0., 0., 0.});
    particles.acceleration.assign(particles.acceleration.size(), {0., 0.});
    return largest_stable_step(w2, damping_rate(), stopped);
  }
} // namespace Morsel::SPH
