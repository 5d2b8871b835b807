#ifndef morsel_study_run_study_h
#define morsel_study_run_study_h

#include <morsel/core/command_line.h>
#include <morsel/study/design.h>

namespace Morsel::Study
{
  /// A study that has been read and checked, with its base scenes.
  struct PreparedStudy
  {
    Study                    study;
    std::vector<PlannedRun>  runs;
    std::vector<std::string> parameters; ///< of the runs' scenes
  };


  /// Reads and checks a study and all scenes of its runs.
  /// @param threads of each run; 0: as the study says
  /// @throw InputError
  PreparedStudy
  prepare_study(const std::string              &file_name,
                const std::vector<std::string> &overrides,
                unsigned int                    threads);


  /// What became of a study.
  struct Outcome
  {
    unsigned int n_failed = 0;  ///< runs
    double       run_time = 0.; ///< wall times of all runs, added up [s]
  };


  /// Carries out what is left of a study's runs, and keeps study.csv and
  /// study.json up to date in the folder of results.
  /// @throw InputError for results that the first runs turn out not to give
  /// @throw NumericalError if no run finished
  /// @throw FileError
  /// @throw Interrupted with what has finished being kept
  Outcome
  carry_out(const PreparedStudy &prepared,
            const std::string   &folder,
            bool                 quiet);


  /// Does both for the study of a command line.
  ///
  /// Runs are processes of their own, so this is for one rank.
  /// @throw InputError for mistakes in the study, before anything is written;
  ///   else as carry_out()
  void
  run_study(const CommandLine &command_line);


  /// @param what starts runs of its own, "A study"
  /// @param section whose entry 'Side by side' says how many go at a time
  /// @throw InputError if the program was started by mpirun
  void
  refuse_several_ranks(const std::string &what    = "A study",
                       const std::string &section = "Study");
} // namespace Morsel::Study

#endif
