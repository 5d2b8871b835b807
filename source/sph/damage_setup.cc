#include <morsel/sph/damage_evolution.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    /// A particle pressed to this share of its area is crushed.
    constexpr double crushed_jacobian = 0.1;


    BondedConstants
    with_driver(BondedConstants              c,
                const Materials::DamageLaw  &law,
                const Materials::Elasticity &material,
                const Kernel                &kernel)
    {
      c.crushed_jacobian = crushed_jacobian;
      c.von_mises_d      = law.von_mises_d;
      c.von_mises_P      = law.von_mises_P;
      c.tensile_strength = law.tensile_strength;
      c.poissons_ratio   = material.poissons_ratio;
      c.youngs_modulus   = material.youngs_modulus;
      c.extension_scale  = law.extension_scale;
      c.average_self     = kernel.value(0.);
      return c;
    }


    double
    area_of_all(const Particles &particles, const ParticleHost<2> *const ranks)
    {
      const double here =
          std::accumulate(particles.area.begin(),
                          particles.area.begin() + particles.n_owned,
                          0.);
      return ranks ? ranks->sum(here) : here;
    }
  } // namespace


  DamageEvolution::DamageEvolution(
      Particles                         &particles,
      Bonds                             &bonds,
      const Kernel                      &kernel,
      const Materials::Elasticity       &material,
      const bool                         linear_law,
      const Materials::DamageLaw        &law,
      const BondedConstants             &loop_constants,
      const Materials::DamageParameters &parameters,
      const double                       friend_distance,
      const unsigned int                 seed,
      const std::vector<double>         &strength,
      const ParticleHost<2> *const       ranks)
      : particles(particles)
      , bonds(bonds)
      , material(material)
      , linear_law(linear_law)
      , law(law)
      , constants(with_driver(loop_constants, law, material, kernel))
      , own_driver(pair_kernels().own_driver[static_cast<int>(law.driver)])
      , average_driver(
            pair_kernels().average_driver[static_cast<int>(law.driver)])
      , soften_lanes(law.growth == Materials::Growth::energy_softening &&
                             law.softening == Materials::Softening::deviator &&
                             particles.fit.empty()
                         ? pair_kernels()
                               .soften[static_cast<int>(law.driver)][linear_law]
                         : nullptr)
      , average_stress(parameters.average_stress)
      , friend_distance_square(friend_distance * friend_distance)
      , hourglass_stiffness(loop_constants.uniform_hourglass)
      , strength(strength)
      , ranks(ranks)
      , local(ranks ? LocalNumbers(particles.id) : LocalNumbers())
      , is_touched(particles.n_local, 0)
      , exposed(particles.n_local, 0)
      , contact_diameter(particles.n_local, particles.spacing)
      , total_area(area_of_all(particles, ranks))
  {
    const unsigned int n     = particles.n_local;
    const unsigned int n_all = ranks ? ranks->n_global() : n;
    particles.damage.assign(n, 0.);
    particles.failed.assign(n, 0);
    particles.effective.assign(n, {0., 0., 0., 0.});
    particles.driver.assign(n, 0.);
    particles.near_face.assign(n, 0);
    particles.damage_heat.assign(n, 0.);
    particles.threshold = Materials::thresholds(
        parameters, law, seed, particles.id, particles.reference, n_all);
    for (unsigned int i = 0; i < strength.size(); ++i)
      particles.threshold[i] *= strength[i];
    if (law.growth == Materials::Growth::energy_softening)
      particles.used.assign(n, 0.);
    if (parameters.flaws == "Benz-Asphaug" &&
        law.growth == Materials::Growth::grady_kipp)
      flaws = std::make_unique<Materials::ExplicitFlaws>(
          Materials::explicit_flaws(law.weibull_modulus, seed, n_all));
    bonds.make_breakable(particles, kernel);
    find_groups_nearby();
    find_direct_bonds();
    measure_cracks();
  }


  void
  DamageEvolution::find_direct_bonds()
  {
    is_direct.assign(bonds.list.index.size(), 0);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
           ++k)
        is_direct[k] =
            bonds.length_square(particles, i, k) > friend_distance_square &&
            !supported(i, k);
  }


  void
  DamageEvolution::measure_cracks()
  {
    const NeighbourList near = find_neighbours(
        particles.reference, particles.n_owned, particles.spacing);
    for (unsigned int i = 0; i < near.n_rows(); ++i)
      for (unsigned int k = near.start[i]; k < near.start[i + 1]; ++k)
        if (bonds.find(i, near.index[k]) < 0)
          contact_diameter[i] =
              std::min(contact_diameter[i],
                       particles.reference[i].distance(
                           particles.reference[near.index[k]]));
  }


  void
  DamageEvolution::find_groups_nearby()
  {
    const unsigned int n_groups = particles.n_groups();
    particles.crushed.assign(n_groups, 0);
    particles.strongest.assign(
        (particles.n_local + group_size - 1) / group_size, 0.);
    any_full.assign(n_groups, 0);
    groups_nearby.start.assign(1, 0);
    std::vector<unsigned int> nearby;
    for (unsigned int g = 0; g < n_groups; ++g)
      {
        const auto &packed = bonds.packed;
        nearby.assign(1, g);
        for (unsigned int k = packed.slot_begin[g] * group_size;
             k < packed.slot_end[g] * group_size;
             ++k)
          nearby.push_back(packed.index[k] / group_size);
        std::sort(nearby.begin(), nearby.end());
        groups_nearby.index.insert(groups_nearby.index.end(),
                                   nearby.begin(),
                                   std::unique(nearby.begin(), nearby.end()));
        groups_nearby.start.push_back(groups_nearby.index.size());

        const auto first = particles.threshold.begin() + g * group_size;
        const auto last =
            first + std::min(group_size, particles.n_owned - g * group_size);
        weakest_of_group.push_back(*std::min_element(first, last));
      }
  }
} // namespace Morsel::SPH
