#ifndef morsel_core_failure_h
#define morsel_core_failure_h

#include <mpi.h>

#include <functional>

namespace Morsel
{
  /// Runs the program's work and turns whatever it throws into one sentence on
  /// stderr and an exit status.
  ///
  /// If all ranks fail, rank 0 alone speaks and every rank returns the status.
  /// If a rank fails alone, the others would wait for it for ever: it then
  /// speaks and ends them all by MPI_Abort with its status. Signals that come
  /// after a failure are noted in silence, see catch_signals().
  /// @return the program's exit status.
  int
  exit_status_of(const std::function<void()> &work);


  /// What rank 0 has to do first, and alone.
  class FirstRank
  {
  public:
    bool
    is_this_rank() const;

    /// Runs the work on rank 0; collective. If it throws there, the same
    /// exception leaves this function on rank 0, and a silent one with
    /// the same status on all others.
    void
    run(const std::function<void()> &work) const;
  };


  /// Runs work that may fail on some ranks only, on all ranks; collective. If
  /// it throws anywhere, the exception leaves this function there, and on all
  /// other ranks one that says the same and has the same status.
  /// @param work not collective: a rank that fails leaves it early
  void
  run_on_all_ranks(const MPI_Comm               communicator,
                   const std::function<void()> &work);
} // namespace Morsel

#endif
