#include "rank_load.h"

#include <morsel/core/mpi_waiting.h>
#include <morsel/core/state_archive.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

namespace Morsel
{
  RankLoad::RankLoad(const MPI_Comm communicator)
      : communicator(communicator)
      , alone(dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      , last_in_mpi(time_in_mpi())
      , busy(dealii::Utilities::MPI::n_mpi_processes(communicator), 0.)
  {}


  void
  RankLoad::sample(const double time)
  {
    if (alone)
      return;
    const auto   now    = Clock::now();
    const double in_mpi = time_in_mpi();
    const double here   = std::chrono::duration<double>(now - last).count() -
                        (in_mpi - last_in_mpi);
    const auto of_ranks =
        dealii::Utilities::MPI::all_gather(communicator, here);
    Interval interval{time, 0., 0.};
    for (unsigned int r = 0; r < busy.size(); ++r)
      {
        busy[r] += of_ranks[r];
        interval.largest = std::max(interval.largest, of_ranks[r]);
        interval.mean += of_ranks[r] / busy.size();
      }
    intervals.push_back(interval);
    last        = Clock::now();
    last_in_mpi = time_in_mpi();
  }


  void
  RankLoad::exchange_state(StateArchive &state)
  {
    std::vector<double>   of_ranks = busy;
    std::vector<Interval> before   = intervals;
    state.same(of_ranks, before);
    if (of_ranks.size() != busy.size())
      return;
    busy      = of_ranks;
    intervals = before;
  }


  double
  RankLoad::imbalance(const double begin, const double end) const
  {
    double largest = 0., mean = 0.;
    for (const Interval &interval : intervals)
      if (interval.time > begin && interval.time <= end)
        {
          largest += interval.largest;
          mean += interval.mean;
        }
    return mean > 0. ? largest / mean : 1.;
  }


  void
  RankLoad::summarise(Output::Summary &summary,
                      RunLog          &log,
                      const double     time_of_peak) const
  {
    if (alone)
      return;
    constexpr double forever = std::numeric_limits<double>::max();
    const double     mean =
        std::accumulate(busy.begin(), busy.end(), 0.) / busy.size();
    summary.add("rank_busy_time",
                mean,
                "s",
                "of the loop, that a rank did not spend within MPI, the mean "
                "over the ranks");
    summary.add("rank_busy_time_largest",
                *std::max_element(busy.begin(), busy.end()),
                "s",
                "the same of the rank that was busy longest");
    summary.add("rank_imbalance",
                imbalance(-forever, forever),
                "1",
                "busy time of the busiest rank over the mean, from sample to "
                "sample: what the best balance at any time could save");
    if (time_of_peak > 0.)
      {
        summary.add("rank_imbalance_before_peak",
                    imbalance(-forever, time_of_peak),
                    "1",
                    "the same until the peak of the force");
        summary.add("rank_imbalance_after_peak",
                    imbalance(time_of_peak, forever),
                    "1",
                    "the same from then on");
      }
    log << "Rank                           busy [s]\n";
    for (unsigned int r = 0; r < busy.size(); ++r)
      {
        char line[64];
        std::snprintf(line, sizeof(line), "%-28u %10.3f\n", r, busy[r]);
        log << line;
      }
  }
} // namespace Morsel
