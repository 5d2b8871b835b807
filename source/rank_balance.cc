#include "rank_balance.h"

#include <morsel/core/state_archive.h>

#include <algorithm>
#include <numeric>

namespace Morsel
{
  namespace
  {
    /// What a change has to save, relative.
    constexpr double least_gain = 0.02;
  } // namespace


  RankBalance::RankBalance(const bool wanted, const MPI_Comm communicator)
      : communicator(communicator)
      , looks(wanted &&
              dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
  {}


  void
  RankBalance::exchange_state(StateArchive &state)
  {
    state.same(waited);
  }


  RankBalance::Work
  RankBalance::of_ranks(const std::vector<const SPH::Solid *> &bodies) const
  {
    double mine = 0.;
    for (const SPH::Solid *const body : bodies)
      {
        const auto work = body->work_of_particles();
        mine += std::accumulate(work.begin(), work.end(), 0.);
      }
    const auto over_ranks =
        dealii::Utilities::MPI::min_max_avg(mine, communicator);
    return {over_ranks.avg, over_ranks.max};
  }


  std::optional<Partition>
  RankBalance::better_partition(const std::vector<const SPH::Solid *> &bodies)
  {
    const auto has_broken = [](const SPH::Solid *const body) {
      return body->failed_share() > 0.;
    };
    if (std::none_of(bodies.begin(), bodies.end(), has_broken))
      return {};
    const Work work = of_ranks(bodies);
    waited += (work.largest / work.mean - 1.) * steps_between_looks;
    double to_set_up = 0.;
    for (const SPH::Solid *const body : bodies)
      to_set_up = std::max(to_set_up, body->steps_to_set_up());
    if (waited < to_set_up)
      return {};
    waited = 0.;

    // Ranks get whole cells: none gets more than its share and one cell of
    // each body.
    Partition partition;
    double    fair = work.mean;
    for (const SPH::Solid *const body : bodies)
      {
        partition.push_back(
            body->get_host().work_in_cells(body->work_of_particles()));
        fair +=
            *std::max_element(partition.back().begin(), partition.back().end());
      }
    if (fair > (1. - least_gain) * work.largest)
      return {};
    return partition;
  }
} // namespace Morsel
