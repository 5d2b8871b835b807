#ifndef morsel_study_results_h
#define morsel_study_results_h

#include <morsel/study/evaluation.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace Morsel::Study
{
  /// study.csv: one row per run with axis values, quantities, truths, errors,
  /// time, memory, unknowns, status. Texts stand in quotation marks where they
  /// hold commas.
  std::string
  study_csv(const Study &study, const std::vector<Row> &rows);


  /// study.json: the same with units and meanings, and what follows from it:
  /// fitted rates, Pareto fronts, time to reach given errors, statistics over
  /// draws.
  nlohmann::ordered_json
  study_json(const Study &study, const std::vector<Row> &rows);
} // namespace Morsel::Study

#endif
