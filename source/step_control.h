#ifndef morsel_source_step_control_h
#define morsel_source_step_control_h

#include "guards.h"
#include "run_state.h"

#include <morsel/core/state_archive_fwd.h>

#include <optional>
#include <string>

namespace Morsel
{
  /// Keeps two good states of a run, the last one and one well before, and
  /// decides from which of them and with what step it is to be tried again
  /// when a guard finds bad numbers.
  ///
  /// The last state may be good by the guards' measures and yet hold what grows
  /// into the same failure: if that comes back at the same time, the next
  /// try begins from the other one.
  class StepControl
  {
  public:
    /// @param retries at most
    explicit StepControl(const unsigned int retries)
        : most_retries(retries)
    {}

    /// Whether a state is to be kept after so many steps.
    bool
    wants_state(unsigned long long step) const;

    /// Takes a state that the guards have found good.
    void
    keep(RunState &&state);

    /// What to try next.
    /// @param moment of the finding
    /// @return the state from which to go on with half the step, or nothing if
    ///   that would not help or has not helped
    const RunState *
    retry(const Finding &finding, const Moment &moment);

    /// The step after a retry [s].
    double
    time_step() const
    {
      return tried.back();
    }

    /// The last good one.
    const RunState *
    last_good() const
    {
      return last ? &*last : nullptr;
    }

    /// Tries anew.
    void
    forget_tries()
    {
      tried.clear();
      failure.reset();
      from_earlier = false;
    }

    /// What has been tried, and the good states. These cannot be given to
    /// another number of ranks: there is none then.
    void
    exchange_state(StateArchive &state);

    /// Of all retries [s].
    const std::vector<double> &
    steps_tried() const
    {
      return tried;
    }

  private:
    struct Failure
    {
      Finding::Kind kind;
      double        time, time_step; ///< [s]
    };

    const unsigned int      most_retries;
    std::optional<RunState> last, earlier;
    std::vector<double>     tried;
    std::optional<Failure>  failure; ///< the last one
    bool                    from_earlier = false;
  };
} // namespace Morsel

#endif
