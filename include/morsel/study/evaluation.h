#ifndef morsel_study_evaluation_h
#define morsel_study_evaluation_h

#include <morsel/study/record.h>

#include <optional>
#include <string>
#include <vector>

namespace Morsel::Study
{
  /// A quantity of one run beside its truth; what is not known is empty.
  struct Measured
  {
    std::optional<double> value;
    std::optional<double> truth;
    /// (value - truth) / scale, signed; empty for the run that is the truth.
    std::optional<double> error;
  };


  /// One run as the study sees it: a row of study.csv.
  struct Row
  {
    Row(const PlannedRun &run, const Record &record)
        : run(&run)
        , record(&record)
    {}

    const PlannedRun     *run;
    const Record         *record;
    std::vector<Measured> quantities; ///< as in Study::quantities
    std::optional<double> resolution;
    std::optional<double> time;                ///< median [s]
    std::optional<double> time_low, time_high; ///< extremes [s]
    std::optional<double> memory;              ///< [B]
    std::optional<double> unknowns;
  };


  /// Checks what can be known of expressions and truths before anything runs.
  /// @throw InputError with the place of the mistake
  void
  check_formulas(const Study &study, const std::vector<PlannedRun> &runs);


  /// Checks that the runs give what the study asks for, as soon as a run of
  /// every series has finished.
  /// @throw InputError naming the result that no run gives
  void
  check_results(const Study                   &study,
                const std::vector<PlannedRun> &runs,
                const std::vector<Record>     &records);


  /// The rows, in the order of the runs.
  std::vector<Row>
  evaluate_runs(const Study                   &study,
                const std::vector<PlannedRun> &runs,
                const std::vector<Record>     &records);
} // namespace Morsel::Study

#endif
