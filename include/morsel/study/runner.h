#ifndef morsel_study_runner_h
#define morsel_study_runner_h

#include <morsel/study/record.h>

#include <functional>
#include <list>
#include <string>
#include <vector>

namespace Morsel::Study
{
  /// Carries out the runs of a study as processes of their own, each in a
  /// folder of its own under <output>/runs, and keeps their records.
  class Runner
  {
  public:
    /// Finds out which runs have finished before, under the same fingerprint.
    /// @param parameters of the runs' scenes, from scene_parameters()
    Runner(const Study                    &study,
           const std::vector<PlannedRun>  &runs,
           const std::vector<std::string> &parameters,
           const std::string              &output);

    /// Runs what is left to do; a run that fails is recorded as failed.
    /// @param after_each called with the run's index once it has come to its
    ///   end; if it throws, the other runs are ended and the exception goes on
    /// @throw Interrupted after SIGINT or SIGTERM; records of finished runs
    ///   stay
    void
    run(const std::function<void(unsigned int)> &after_each);

    const std::vector<Record> &
    get_records() const
    {
      return records;
    }

  private:
    struct Active
    {
      unsigned int                  run;
      std::unique_ptr<ChildProcess> process;
    };

    /// The runs that are left, the first of each series first, so that
    /// mistakes show early.
    std::list<unsigned int>
    waiting_runs() const;

    std::unique_ptr<ChildProcess>
    start(unsigned int run) const;

    /// Takes the results of a process; whether the run is over.
    bool
    take_results(unsigned int run, const Ended &ended);

    std::string
    folder_of(unsigned int run) const;

    std::string
    messages_of(unsigned int run) const;

    const Study                   &study;
    const std::vector<PlannedRun> &runs;
    std::string                    output;
    std::vector<Record>            records;
  };
} // namespace Morsel::Study

#endif
