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
    /// Groups that are worth a task of their own.
    constexpr unsigned int grain = 64;
  } // namespace


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
    return !linear_law && !((1. + H.xx) * (1. + H.yy) - H.xy * H.yx >
                            constants.crushed_jacobian);
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
