#ifndef morsel_study_claims_h
#define morsel_study_claims_h

#include <morsel/study/evaluation.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace Morsel::Study
{
  /// For each claim what is stated and what the study finds, null where it
  /// finds nothing, with a note that says why.
  nlohmann::ordered_json
  claims_json(const Study &study, const std::vector<Row> &rows);


  /// The figures of what runs left, with the indices of their finished runs.
  nlohmann::ordered_json
  figures_json(const Study &study, const std::vector<Row> &rows);


  /// Checks that each claim means one run, or the draws of one setting.
  /// @throw InputError if it means none, or several
  void
  check_claims(const Study &study, const std::vector<PlannedRun> &runs);
} // namespace Morsel::Study

#endif
