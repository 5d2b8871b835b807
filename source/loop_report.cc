#include "loop_report.h"

#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>

#include <deal.II/base/mpi.h>

namespace Morsel
{
  void
  add_loop_report(Output::Summary &summary, const LoopReport &report)
  {
    const bool failed = !report.failure.empty();
    summary.add_text("status",
                     failed               ? "failed"
                     : report.interrupted ? "interrupted"
                                          : "done");
    if (failed)
      summary.add_text("failure", report.failure);
    summary.add("step_retries",
                report.step_retries,
                "1",
                "how often the run went back to a good state and on with half "
                "the time step");
    if (report.step_retries > 0)
      summary.add("first_time_step",
                  report.first_time_step,
                  "s",
                  "before the first of these retries");
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      summary.add("repartitions",
                  report.repartitions,
                  "1",
                  "how often particles changed ranks for a better balance");
    summary.add_effect(
        {"step control", report.step_retries > 0, "Time/Retries"});
  }


  void
  end_run(const LoopReport &report, const double time, const std::string &kept)
  {
    if (!report.failure.empty())
      throw NumericalError(report.failure);
    if (report.interrupted)
      throw Interrupted("Interrupted at " + number_text(time) + " s; " + kept);
  }
} // namespace Morsel
