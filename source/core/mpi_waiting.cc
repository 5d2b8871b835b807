#include <morsel/core/mpi_waiting.h>

#include <mpi.h>

#include <chrono>

namespace
{
  double seconds_in_mpi = 0.;


  /// @param function under its name in the profiling interface
  template <typename... Parameters, typename... Arguments>
  int
  timed(int (*function)(Parameters...), const Arguments... arguments)
  {
    using Clock      = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const int  error = function(arguments...);
    seconds_in_mpi +=
        std::chrono::duration<double>(Clock::now() - begin).count();
    return error;
  }
} // namespace


namespace Morsel
{
  double
  time_in_mpi()
  {
    return seconds_in_mpi;
  }
} // namespace Morsel


// What the standard calls by PMPI_... does the work.
extern "C" {
int
MPI_Wait(MPI_Request *request, MPI_Status *status)
{
  return timed(&PMPI_Wait, request, status);
}


int
MPI_Waitall(int count, MPI_Request requests[], MPI_Status statuses[])
{
  return timed(&PMPI_Waitall, count, requests, statuses);
}


int
MPI_Barrier(MPI_Comm communicator)
{
  return timed(&PMPI_Barrier, communicator);
}


int
MPI_Bcast(void        *data,
          int          count,
          MPI_Datatype type,
          int          root,
          MPI_Comm     communicator)
{
  return timed(&PMPI_Bcast, data, count, type, root, communicator);
}


int
MPI_Allreduce(const void  *sent,
              void        *received,
              int          count,
              MPI_Datatype type,
              MPI_Op       operation,
              MPI_Comm     communicator)
{
  return timed(
      &PMPI_Allreduce, sent, received, count, type, operation, communicator);
}


int
MPI_Gather(const void  *sent,
           int          sent_count,
           MPI_Datatype sent_type,
           void        *received,
           int          received_count,
           MPI_Datatype received_type,
           int          root,
           MPI_Comm     communicator)
{
  return timed(&PMPI_Gather,
               sent,
               sent_count,
               sent_type,
               received,
               received_count,
               received_type,
               root,
               communicator);
}


int
MPI_Allgather(const void  *sent,
              int          sent_count,
              MPI_Datatype sent_type,
              void        *received,
              int          received_count,
              MPI_Datatype received_type,
              MPI_Comm     communicator)
{
  return timed(&PMPI_Allgather,
               sent,
               sent_count,
               sent_type,
               received,
               received_count,
               received_type,
               communicator);
}


int
MPI_Allgatherv(const void  *sent,
               int          sent_count,
               MPI_Datatype sent_type,
               void        *received,
               const int    received_counts[],
               const int    displacements[],
               MPI_Datatype received_type,
               MPI_Comm     communicator)
{
  return timed(&PMPI_Allgatherv,
               sent,
               sent_count,
               sent_type,
               received,
               received_counts,
               displacements,
               received_type,
               communicator);
}
}
