#ifndef morsel_source_loop_report_h
#define morsel_source_loop_report_h

#include <morsel/output/summary.h>

#include <string>

namespace Morsel
{
  /// How a time loop went.
  struct LoopReport
  {
    bool         interrupted     = false;
    unsigned int step_retries    = 0;
    unsigned int repartitions    = 0;
    double       first_time_step = 0.; ///< [s]
    std::string failure; ///< the sentence of the guard that stopped it, or none
  };


  /// How the run ended and whether its step had to become smaller.
  void
  add_loop_report(Output::Summary &summary, const LoopReport &report);


  /// What the program says of a run that did not end as it should; nothing of
  /// one that did.
  /// @param time that it has reached [s]
  /// @param kept of an interrupted one, and where
  /// @throws NumericalError, Interrupted
  void
  end_run(const LoopReport &report, double time, const std::string &kept);
} // namespace Morsel

#endif
