#ifndef morsel_core_gather_h
#define morsel_core_gather_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace Morsel
{
  /// The records of all ranks, those of rank 0 first, on every rank.
  /// Collective. Where no rank has any, it costs one small message.
  template <typename Record>
  std::vector<Record>
  gather(const std::vector<Record> &own, const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable<Record>::value,
                  "Records travel as bytes.");
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return own;
    const int        bytes = own.size() * sizeof(Record);
    std::vector<int> counts(n_ranks), starts(n_ranks, 0);
    int              error = MPI_Allgather(
        &bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
    AssertThrowMPI(error);
    std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
    std::vector<Record> all((starts.back() + counts.back()) / sizeof(Record));
    if (all.empty())
      return all;
    error = MPI_Allgatherv(own.data(),
                           bytes,
                           MPI_BYTE,
                           all.data(),
                           counts.data(),
                           starts.data(),
                           MPI_BYTE,
                           communicator);
    AssertThrowMPI(error);
    return all;
  }
} // namespace Morsel

#endif
