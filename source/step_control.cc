#include "step_control.h"

#include <morsel/core/state_archive.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace Morsel
{
  namespace
  {
    /// A state costs as much time as about one step.
    constexpr unsigned int steps_between_states = 500;

    /// A run that fails early is to leave more than its beginning.
    constexpr std::array<unsigned int, 3> first_states = {{50, 100, 200}};

    /// From the earlier state to the last one, at least.
    constexpr unsigned int steps_well_before = 10 * steps_between_states;

    /// Failures that are this many steps apart are the same.
    constexpr double steps_alike = 100.;
  } // namespace


  bool
  StepControl::wants_state(const unsigned long long step) const
  {
    return step % steps_between_states == 0 ||
           std::find(first_states.begin(), first_states.end(), step) !=
               first_states.end();
  }


  void
  StepControl::keep(RunState &&state)
  {
    if (!last || !earlier)
      earlier = last;
    else if (last->step >= earlier->step + steps_well_before)
      earlier = std::move(last);
    last = std::move(state);
  }


  void
  StepControl::exchange_state(StateArchive &state)
  {
    state.same(tried, failure, from_earlier);
    for (auto *const kept : {&last, &earlier})
      {
        bool present = kept->has_value();
        state.same(present);
        if (state.loads())
          kept->reset();
        if (!present)
          continue;
        if (state.loads())
          kept->emplace();
        RunState &good = **kept;
        if (!state.cache(good.partition,
                         good.system,
                         good.recorder,
                         good.time,
                         good.step,
                         good.time_step))
          kept->reset();
      }
  }


  const RunState *
  StepControl::retry(const Finding &finding, const Moment &moment)
  {
    const bool again =
        failure &&
        moment.time <= failure->time + steps_alike * failure->time_step;
    const bool safe_again = again && failure->kind == finding.kind &&
                            failure->time_step <= moment.safe_time_step &&
                            std::abs(moment.time - failure->time) <=
                                steps_alike * failure->time_step;
    failure = Failure{finding.kind, moment.time, moment.time_step};
    if (tried.size() == most_retries || !finding.may_be_the_step() || !last ||
        (safe_again && from_earlier))
      return nullptr;
    from_earlier = again;
    if (again && earlier)
      last = earlier;
    tried.push_back(0.5 * moment.time_step);
    return &*last;
  }
} // namespace Morsel
