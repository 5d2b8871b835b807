#ifndef morsel_study_run_study_h
#define morsel_study_run_study_h

#include <morsel/core/command_line.h>

namespace Morsel::Study
{
  /// Reads and checks a study, carries out what is left of its runs, and keeps
  /// study.csv and study.json up to date in the folder of results.
  ///
  /// Runs are processes of their own, so this is for one rank.
  /// @throw InputError for mistakes in the study, before anything is written,
  ///   but for results that the first runs turn out not to give
  /// @throw NumericalError if no run finished
  /// @throw FileError
  /// @throw Interrupted with what has finished being kept
  void
  run_study(const CommandLine &command_line);
} // namespace Morsel::Study

#endif
