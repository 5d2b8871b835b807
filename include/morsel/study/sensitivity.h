#ifndef morsel_study_sensitivity_h
#define morsel_study_sensitivity_h

#include <morsel/study/evaluation.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace Morsel::Study
{
  /// Appends to the runs two variations of each for every sensitivity: the
  /// same run with one entry at its low and at its high value.
  /// @throw InputError where the base scene's value is needed and is no number
  void
  append_variations(const Study &study, std::vector<PlannedRun> &runs);


  /// "alpha = 0.5", or empty for a run without variation.
  std::string
  variation_text(const PlannedRun &run);


  /// {"sensitivity", "side", "value"}, or null.
  nlohmann::ordered_json
  variation_json(const PlannedRun &run);


  /// What is varied, as the study describes it.
  nlohmann::ordered_json
  sensitivities_json(const Study &study);


  /// Relative changes of all quantities by series and setting, the largest
  /// first. Draws are compared one by one with the run that differs in nothing
  /// else: a change is the mean of these differences over the mean of the
  /// base, and its standard error is that of the differences.
  nlohmann::ordered_json
  sensitivity_changes(const Study &study, const std::vector<Row> &rows);
} // namespace Morsel::Study

#endif
