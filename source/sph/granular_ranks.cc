// Unbonded pairs of particles of different ranks, and the work of each.

#include <morsel/sph/granular.h>

#include <algorithm>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    /// What unbonded pairs take, in hundredths of a bonded particle's work
    /// (measured, doc/performance.md): for each member of the list and each
    /// grain, and in a row for each slot of its group and each live pair.
    constexpr unsigned int work_of_member = 50, work_of_grain = 65,
                           work_of_slot = 6, work_of_live_pair = 10;


    struct Rates
    {
      GrainMotion motion;
      double      area; ///< [m^2]
    };


    struct State
    {
      GrainMotion motion;
      GrainStress stress;
    };
  } // namespace


  void
  Granular::find_foreign(const double reach)
  {
    std::vector<dealii::Point<2>> all;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      all.push_back(particles.position(i));
    exchange->find(built_at, all, built_at, grid, reach, kernel.support());
    travelled_at_build = particles.travelled;
    foreign.clear();
    exchange->exchange<Foreign>(
        [&](const unsigned int m) -> Foreign {
          const unsigned int i = members[m];
          return {particles.id[i],
                  built_at[m],
                  member_size(m),
                  particles.mass[i],
                  allowance[m],
                  member_failed[m] != 0};
        },
        [&](const unsigned int, const Foreign &f) { foreign.push_back(f); });
    for (const Foreign &f : foreign)
      {
        member_failed.push_back(f.failed);
        allowance.push_back(f.allowance);
      }

    // The search is that of the plan: round the foreign ones in this rank's
    // grid, for theirs may lie anywhere.
    foreign_near.start.assign(members.size() + 1, 0);
    const auto for_pairs = [&](const auto &work) {
      for (unsigned int f = 0; f < foreign.size(); ++f)
        grid.for_each_run(
            foreign[f].place,
            [&](const unsigned int begin, const unsigned int end) {
              for (unsigned int m = begin; m < end; ++m)
                if ((built_at[m] - foreign[f].place).norm_square() <
                    reach * reach)
                  work(m, f);
            });
    };
    for_pairs([&](const unsigned int m, const unsigned int) {
      ++foreign_near.start[m + 1];
    });
    std::partial_sum(foreign_near.start.begin(),
                     foreign_near.start.end(),
                     foreign_near.start.begin());
    foreign_near.index.resize(foreign_near.start.back());
    std::vector<unsigned int> next = foreign_near.start;
    for_pairs([&](const unsigned int m, const unsigned int f) {
      foreign_near.index[next[m]++] = f;
    });
  }


  bool
  Granular::change_concerns_others() const
  {
    // What lies outside of others' boxes stays out of reach of what is in them
    // as long as nothing has gone further than their margin.
    if (particles.travelled - travelled_at_build > 0.5 * kernel.support())
      return true;
    return std::any_of(
        changed.begin(), changed.end(), [&](const unsigned int i) {
          const unsigned int m = number[i];
          return m < n_in_grid
                     ? foreign_near.start[m] < foreign_near.start[m + 1]
                     : exchange->is_near_others(particles.position(i));
        });
  }


  void
  Granular::exchange_rates_of_members()
  {
    const unsigned int n = first_foreign();
    exchange->exchange<Rates>(
        [&](const unsigned int m) -> Rates {
          return {motion[m], area[m]};
        },
        [&](const unsigned int f, const Rates &rates) {
          motion[n + f] = rates.motion;
          area[n + f]   = rates.area;
        });
  }


  void
  Granular::exchange_state_of_members()
  {
    const unsigned int n = first_foreign();
    exchange->exchange<State>(
        [&](const unsigned int m) -> State {
          return {motion[m], member_stress[m]};
        },
        [&](const unsigned int f, const State &state) {
          motion[n + f]        = state.motion;
          member_stress[n + f] = state.stress;
        });
  }


  void
  Granular::add_work(std::vector<unsigned int> &of_particles) const
  {
    for (const Block &block : blocks)
      {
        for (unsigned int r = 0; r < block.n_rows; ++r)
          {
            const unsigned int g = r / group_size;
            of_particles[members[block.row[r]]] +=
                work_of_slot * (block.slot_begin[g + 1] - block.slot_begin[g]);
          }
        for (unsigned int m = block.first; m < block.last; ++m)
          of_particles[members[m]] +=
              work_of_member + (member_failed[m] ? work_of_grain : 0) +
              work_of_live_pair * (block.live_start[m - block.first + 1] -
                                   block.live_start[m - block.first]);
      }
  }
} // namespace Morsel::SPH
