#ifndef morsel_source_rank_load_h
#define morsel_source_rank_load_h

#include <morsel/core/log.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/output/summary.h>

#include <mpi.h>

#include <chrono>
#include <vector>

namespace Morsel
{
  /// How evenly the work of a time loop is spread over the ranks: the time that
  /// each is busy, which is all but that within calls of MPI, from sample to
  /// sample. Collective, and nothing on one rank.
  class RankLoad
  {
  public:
    explicit RankLoad(MPI_Comm communicator);

    /// @param time simulated [s]
    void
    sample(double time);

    /// What has been measured on as many ranks; not the time since the last
    /// sample.
    void
    exchange_state(StateArchive &state);

    /// @param time_of_peak simulated [s], which parts the loop in two; or 0:
    /// nothing does
    void
    summarise(Output::Summary &summary, RunLog &log, double time_of_peak) const;

  private:
    /// Between two samples.
    struct Interval
    {
      double time;          ///< simulated, at its end [s]
      double largest, mean; ///< wall time for which ranks were busy [s]
    };

    /// What no rebalancing at any sample could better: the busiest ranks' time
    /// over the mean, interval by interval.
    double
    imbalance(double begin, double end) const;

    using Clock = std::chrono::steady_clock;

    const MPI_Comm        communicator;
    const bool            alone;
    Clock::time_point     last = Clock::now();
    double                last_in_mpi;
    std::vector<Interval> intervals;
    std::vector<double>   busy; ///< of each rank so far [s]
  };
} // namespace Morsel

#endif
