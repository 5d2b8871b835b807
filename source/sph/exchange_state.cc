// What the bodies of particles remember from step to step.

#include <morsel/core/state_archive.h>
#include <morsel/sph/applied_conditions.h>
#include <morsel/sph/body_contact.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/updated_lagrangian.h>

namespace Morsel::SPH
{
  void
  Particles::exchange_state(StateArchive &state)
  {
    state.name_particles(id, n_owned);
    state.particles(motion, half_velocity, acceleration, gradient);
    state.particles(shape, fit, deficit, own_sum, pair_stress, fit_stress);
    state.particles(hourglass, viscous, viscous_heat);
    state.particles(damage, failed, used, effective, driver, near_face);
    state.particles(damage_heat);
    state.cache(crushed, strongest);
  }


  void
  Particles::exchange_motion(StateArchive &state)
  {
    state.name_particles(id, n_owned);
    state.particles(motion, half_velocity, viscous_heat);
  }


  void
  Leapfrog::exchange_state(StateArchive &state)
  {
    state.same(last_step);
  }


  void
  Bonds::exchange_state(StateArchive &state)
  {
    // Bonds break on one rank only, where entries keep their places.
    std::vector<char> still_live = live;
    state.cache(still_live, packed.slot_end, packed.near_end);
    if (state.loads() && still_live.size() == live.size())
      for (unsigned int k = 0; k < live.size(); ++k)
        if (live[k] && !still_live[k])
          cut(k);
  }


  void
  DamageEvolution::exchange_state(StateArchive &state)
  {
    state.same(heat_of_bonds, failed_area);
    state.cache(exposed, contact_diameter, weakest_of_group, any_full);
  }


  void
  Granular::exchange_state(StateArchive &state)
  {
    state.particles(ratio, deviator, energy, grain_heat, pair_friction_heat);
    state.particles(penalty_energy);
    state.same(any_failed, stale);
    if (state.loads())
      watch.forget();
    state.cache(members, member_failed, built_at);
    state.cache(motion, member_stress, size, area, mass);
    std::size_t n_blocks = blocks.size();
    state.cache(n_blocks);
    blocks.resize(n_blocks);
    for (Block &block : blocks)
      state.cache(block.first,
                  block.last,
                  block.grain_start,
                  block.grain_pair,
                  block.live_start,
                  block.live_pair);
  }


  void
  Solid::exchange_state(StateArchive &state)
  {
    finish_motion();
    if (fracture)
      particles.exchange_state(state);
    else
      particles.exchange_motion(state);
    leapfrog.exchange_state(state);
    if (fracture)
      {
        bonds.exchange_state(state);
        fracture->exchange_state(state);
      }
    if (granular)
      granular->exchange_state(state);
  }


  void
  UpdatedLagrangian::exchange_state(StateArchive &state)
  {
    particles.exchange_state(state);
    leapfrog.exchange_state(state);
    state.particles(density, area, sigma, stress_work, artificial_heat);
    state.particles(place, artificial);
    state.cache(neighbours.start, neighbours.index, searched_at, searches);
    state.cache(weight, closeness, offset);
  }


  void
  BodyContact::exchange_state(StateArchive &state)
  {
    state.cache(pairs, searched_a, searched_b);
    state.sum(energy, heat);
  }


  void
  AppliedCondition::exchange_state(StateArchive &state)
  {
    state.same(total, given, impulse_to_come, done, to_come);
    for (Loaded &l : loaded)
      state.same(l.force);
    for (Prescribed &q : prescribed)
      state.same(q.target, q.reaction);
  }


  void
  AppliedConditions::exchange_state(StateArchive &state)
  {
    state.same(last_step);
    for (auto &condition : conditions)
      condition->exchange_state(state);
  }
} // namespace Morsel::SPH
