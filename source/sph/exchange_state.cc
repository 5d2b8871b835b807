// What the bodies of particles remember from step to step.

#include <morsel/core/state_archive.h>
#include <morsel/sph/applied_conditions.h>
#include <morsel/sph/body_contact.h>
#include <morsel/sph/local_numbers.h>
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
  Bonds::exchange_state(StateArchive &state, const Particles &particles)
  {
    // By the ids of their ends, which are the same on any number of ranks.
    std::vector<std::vector<unsigned long long>> ends(list.n_rows());
    for (unsigned int i = 0; i < list.n_rows() && !state.loads(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        if (!live[k])
          ends[i].push_back(particles.id[list.index[k]]);
    state.particles(ends);
    if (!state.loads())
      return;
    const LocalNumbers local(particles.id);
    for (unsigned int i = 0; i < ends.size(); ++i)
      for (const unsigned long long id : ends[i])
        {
          const long j = local.find(id);
          const long k = j < 0 ? -1 : find(i, j);
          if (k >= 0 && live[k])
            cut(k);
        }
  }


  void
  DamageEvolution::exchange_state(StateArchive &state)
  {
    state.sum(heat_of_bonds);
    state.same(failed_area);
    state.particles(exposed, contact_diameter);
    if (!state.loads())
      return;
    for (unsigned int g = 0; g < particles.n_groups(); ++g)
      {
        retire_group(g);
        if (law.growth == Materials::Growth::energy_softening)
          weakest_of_group[g] = weakest_in(g);
      }
  }


  void
  Granular::exchange_state(StateArchive &state)
  {
    state.particles(ratio, deviator, energy, grain_heat, pair_friction_heat);
    state.particles(penalty_energy);
    state.same(any_failed);
    state.cache(members, member_failed, built_at, allowance);
    state.cache(n_in_grid, dummy, changed, longest_allowance);
    state.cache(motion, member_stress, size, area, mass, foreign);

    // As many records on any number of ranks.
    using Lists = std::vector<std::vector<unsigned int>>;
    Lists               plan, lists;
    std::vector<double> boxes;
    if (exchange)
      {
        plan  = exchange->get_plan();
        boxes = exchange->get_boxes();
      }
    double travelled = exchange ? particles.travelled - travelled_at_build : 0.;
    state.cache(foreign_near.start, foreign_near.index, boxes, travelled);
    if (state.loads())
      travelled_at_build = particles.travelled - travelled;
    for (const Block &block : blocks)
      lists.insert(lists.end(),
                   {{block.first, block.last, block.n_rows, block.n_grains},
                    block.row,
                    block.slot_begin,
                    block.grain_pair,
                    block.live_start,
                    block.live_pair});
    // They are of the ranks that saved them.
    const bool there = state.cache(stale, plan, lists);
    stale            = stale || !there;
    if (!state.loads() || !there)
      return;
    if (exchange)
      {
        exchange->set_plan(plan);
        exchange->set_boxes(boxes);
      }
    number_members();
    grid.build({built_at.begin(), built_at.begin() + n_in_grid},
               kernel.support() + 2. * longest_allowance);
    blocks.clear();
    for (unsigned int k = 0; k + 5 < lists.size(); k += 6)
      blocks.push_back({lists[k][0],
                        lists[k][1],
                        lists[k][2],
                        lists[k][3],
                        lists[k + 1],
                        lists[k + 2],
                        lists[k + 3],
                        lists[k + 4],
                        lists[k + 5]});
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
        bonds.exchange_state(state, particles);
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
    state.cache(pairs);
    for (Side &side : sides)
      {
        // As many records on any number of ranks.
        std::vector<std::vector<unsigned int>> plan;
        if (side.exchange)
          plan = side.exchange->get_plan();
        const bool there = state.cache(side.searched, side.foreign, plan);
        if (state.loads() && there && side.exchange)
          {
            side.exchange->set_plan(plan);
            side.foreign_now.resize(side.foreign.size());
          }
      }
    state.sum(energy, heat);
  }


  void
  AppliedCondition::exchange_state(StateArchive &state)
  {
    // Forces are worked out anew before they are asked for.
    state.sum(done, to_come, given.x, given.y);
    state.sum(impulse_to_come.x, impulse_to_come.y);
  }


  void
  AppliedConditions::exchange_state(StateArchive &state)
  {
    state.same(last_step);
    for (auto &condition : conditions)
      condition->exchange_state(state);
  }
} // namespace Morsel::SPH
