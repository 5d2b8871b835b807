#ifndef morsel_source_rank_balance_h
#define morsel_source_rank_balance_h

#include "run_state.h"

#include <morsel/core/state_archive_fwd.h>
#include <morsel/sph/solid.h>

#include <deal.II/base/mpi.h>

#include <optional>
#include <vector>

namespace Morsel
{
  /// Decides when particles change ranks as the food breaks: once the time that
  /// ranks have waited for the busiest one, as the model of their work says, is
  /// more than it takes to set the run up anew. So a change takes no more
  /// than what has been lost without it. The model counts and does not measure:
  /// the same run does the same again.
  class RankBalance
  {
  public:
    /// @param wanted whether anything is to change
    RankBalance(bool wanted, MPI_Comm communicator);

    /// Whether it is time to look at the work of the ranks, after so many
    /// steps; never on one rank.
    bool
    is_due(const unsigned long long step) const
    {
      return looks && step % steps_between_looks == 0;
    }

    /// Collective. @return what to go on with, if that is worth a change
    std::optional<Partition>
    better_partition(const std::vector<const SPH::Solid *> &bodies);

    void
    exchange_state(StateArchive &state);

  private:
    /// Of one rank, or one cell, in hundredths of a sound particle's.
    struct Work
    {
      double mean, largest;
    };

    static constexpr unsigned int steps_between_looks = 50;

    Work
    of_ranks(const std::vector<const SPH::Solid *> &bodies) const;

    const MPI_Comm communicator;
    const bool     looks;
    double         waited = 0.; ///< in steps
  };
} // namespace Morsel

#endif
