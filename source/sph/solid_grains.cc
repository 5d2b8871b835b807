#include <morsel/materials/grains.h>
#include <morsel/sph/solid.h>

#include <algorithm>

namespace Morsel::SPH
{
  void
  Solid::scatter_modulus(const Scene::ParticleBody &body,
                         const unsigned int         seed)
  {
    if (!body.grains.scatter_modulus())
      return;
    const Materials::GrainField grains(
        body.grains, material.poissons_ratio, seed);
    for (const dealii::Point<2> &x : particles.reference)
      particles.modulus.push_back(grains.modulus_factor(x));
  }


  double
  Solid::largest_modulus_factor() const
  {
    double largest = particles.modulus.empty() ? 1. : 0.;
    for (const double f : particles.modulus)
      largest = std::max(largest, f);
    return host.maximum(largest);
  }


  std::vector<double>
  Solid::strength_of_grains(const Scene::ParticleBody &body,
                            const unsigned int         seed) const
  {
    std::vector<double> strength;
    if (!body.grains.scatter_strength())
      return strength;
    const Materials::GrainField grains(
        body.grains, material.poissons_ratio, seed);
    for (const dealii::Point<2> &x : particles.reference)
      strength.push_back(grains.strength_factor(x));
    return strength;
  }
} // namespace Morsel::SPH
