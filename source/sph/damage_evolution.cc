#include <morsel/core/parallel.h>
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

    /// Groups that are worth a task of their own.
    constexpr unsigned int grain = 64;


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


  const std::vector<unsigned int> &
  DamageEvolution::update(const double coming_step)
  {
    time_step = coming_step;
    newly_failed.clear();
    parted.clear();
    failed_anywhere = false;
    if (ranks)
      exchange_ghosts_start();

    // With the tensile cut-off everywhere this bounds every average from
    // above: the driver is convex.
    const BondedArrays arrays = bonded_arrays(particles, bonds);
    parallel_for(
        particles.n_groups(),
        [&](unsigned int begin, unsigned int end) {
          own_driver(arrays, constants, begin, end);
        },
        grain);
    if (ranks)
      exchange_ghosts_finish();
    if (ranks && average_stress)
      bound_ghosts();
    std::fill(any_full.begin(), any_full.end(), 0);
    parallel_for(
        particles.n_groups(),
        [&](unsigned int begin, unsigned int end) {
          for (unsigned int g = begin; g < end; ++g)
            if (may_grow(g))
              grow(arrays, g);
        },
        grain);

    failed_now.clear();
    for (unsigned int g = 0; g < particles.n_groups(); ++g)
      if (any_full[g])
        for (unsigned int i = g * group_size;
             i < std::min(particles.n_owned, (g + 1) * group_size);
             ++i)
          if (!particles.failed[i] && particles.damage[i] >= failure_damage)
            failed_now.push_back(i);

    break_up();
    return newly_failed;
  }


  bool
  DamageEvolution::may_grow(const unsigned int g) const
  {
    if (particles.crushed[g])
      return true;
    // No average exceeds the largest driver among the averaged.
    double bound = particles.strongest[g];
    if (average_stress)
      for (unsigned int k = groups_nearby.start[g];
           k < groups_nearby.start[g + 1];
           ++k)
        bound = std::max(bound, particles.strongest[groups_nearby.index[k]]);
    return bound > weakest_of_group[g];
  }


  void
  DamageEvolution::grow(const BondedArrays &arrays, const unsigned int g)
  {
    AveragedStress stress;
    if (average_stress)
      average_driver(arrays, constants, g, stress);
    else
      take_own_stress(g, stress);
    if (soften_lanes)
      soften_group(arrays, g, stress);
    for (unsigned int l = 0; l < group_size; ++l)
      {
        const unsigned int i = g * group_size + l;
        if (i >= particles.n_owned || particles.failed[i])
          continue;
        const double r = particles.threshold[i];
        const double f = strength.empty() ? 1. : strength[i];
        const double s = stress.driver[l];
        if (is_crushed(i))
          release_damage(i, 1.);
        else if (law.growth == Materials::Growth::energy_softening)
          {
            if (!soften_lanes && s > r * (1. - particles.used[i]))
              soften(i, stress.stress(l));
          }
        else if (flaws)
          release_damage(i,
                         Materials::explicit_flaw_damage(
                             law,
                             particles.damage[i],
                             flaws->activated(particles.id[i],
                                              s / (law.threshold_scale * f)),
                             flaws->count(particles.id[i]),
                             time_step));
        else if (law.growth == Materials::Growth::grady_kipp)
          release_damage(
              i,
              Materials::grady_kipp_damage(
                  law, particles.damage[i], s / f, r / f, time_step));
        else
          release_damage(
              i,
              std::max(
                  particles.damage[i],
                  Materials::linear_softening_damage(
                      s, r, law.range_at(r, particles.modulus_factor(i)))));
        if (particles.damage[i] >= failure_damage)
          any_full[g] = 1;
      }
    if (law.growth == Materials::Growth::energy_softening)
      weakest_of_group[g] = weakest_in(g);
  }


  void
  DamageEvolution::take_own_stress(const unsigned int g,
                                   AveragedStress    &stress) const
  {
    for (unsigned int l = 0; l < group_size; ++l)
      {
        const unsigned int i =
            std::min(g * group_size + l, particles.n_owned - 1);
        const Materials::PlaneStrainStress &own = particles.effective[i];
        stress.xx[l]                            = own.xx;
        stress.yy[l]                            = own.yy;
        stress.xy[l]                            = own.xy;
        stress.zz[l]                            = own.zz;
        stress.driver[l]                        = Materials::driver_value(
            law, material, own, !particles.near_face[i]);
      }
  }


  bool
  DamageEvolution::is_crushed(const unsigned int i) const
  {
    const Materials::Tensor2 &H = particles.gradient[i];
    return !linear_law &&
           !((1. + H.xx) * (1. + H.yy) - H.xy * H.yx > crushed_jacobian);
  }


  double
  DamageEvolution::weakest_in(const unsigned int g) const
  {
    double weakest = std::numeric_limits<double>::infinity();
    for (unsigned int i = g * group_size;
         i < std::min(particles.n_owned, (g + 1) * group_size);
         ++i)
      if (!particles.failed[i])
        weakest = std::min(weakest,
                           particles.threshold[i] * (1. - particles.used[i]));
    return weakest;
  }


  void
  DamageEvolution::soften_group(const BondedArrays   &arrays,
                                const unsigned int    g,
                                const AveragedStress &stress)
  {
    GroupSoftening state;
    state.half_velocity = particles.half_velocity.data();
    state.time_step     = time_step;
    bool any            = false;
    for (unsigned int l = 0; l < group_size; ++l)
      {
        const unsigned int i =
            std::min(g * group_size + l, particles.n_owned - 1);
        const double r     = particles.threshold[i];
        state.threshold[l] = r;
        state.used[l]      = particles.used[i];
        state.range[l]     = 0.;
        if (g * group_size + l < particles.n_owned && !particles.failed[i] &&
            stress.driver[l] > r * (1. - particles.used[i]) && !is_crushed(i))
          {
            state.range[l] = law.range_at(r, particles.modulus_factor(i));
            any            = true;
          }
      }
    if (!any || !soften_lanes(arrays, constants, g, stress, state))
      return;
    for (unsigned int l = 0; l < group_size; ++l)
      if (state.range[l] > 0.)
        {
          const unsigned int i = g * group_size + l;
          const double       D = state.used[l] >= failure_damage ||
                                   state.damage[l] >= failure_damage
                                     ? 1.
                                     : state.damage[l];
          particles.used[i]    = state.used[l];
          if (!(D > particles.damage[i]))
            continue;
          particles.damage_heat[i] +=
              state.released[l] * (D - particles.damage[i]);
          set_damage(i, D);
        }
  }


  void
  DamageEvolution::soften(const unsigned int                  i,
                          const Materials::PlaneStrainStress &stress)
  {
    // Most that have softened before do not at this step.
    const double r = particles.threshold[i];
    if (Materials::softened_driver(law,
                                   material,
                                   stress,
                                   !particles.near_face[i],
                                   particles.damage[i]) <=
        r * (1. - particles.used[i]))
      return;
    const Ends                        ends     = ends_of(i);
    const Materials::ElasticResponse &response = ends.response[0];
    const double                      energy =
        particles.modulus_factor(i) *
        (response.deviatoric_energy +
         (response.jacobian < 1. ? 0. : response.volumetric_energy));
    const Materials::Softened now =
        Materials::energy_softening(law,
                                    material,
                                    stress,
                                    !particles.near_face[i],
                                    r,
                                    energy,
                                    {particles.damage[i], particles.used[i]},
                                    particles.modulus_factor(i));
    particles.used[i] = now.used;
    release_damage(i, ends, now.used >= failure_damage ? 1. : now.damage);
  }
} // namespace Morsel::SPH
