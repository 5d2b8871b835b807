#ifndef morsel_core_mpi_waiting_h
#define morsel_core_mpi_waiting_h

namespace Morsel
{
  /// Seconds that this rank has spent in the calls of MPI in which a rank may
  /// wait for others, whoever made them (this program, deal.II, HDF5): they
  /// come by here through MPI's profiling interface, at two reads of the clock
  /// each.
  double
  time_in_mpi();
} // namespace Morsel

#endif
