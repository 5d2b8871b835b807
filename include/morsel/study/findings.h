#ifndef morsel_study_findings_h
#define morsel_study_findings_h

#include <morsel/study/evaluation.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace Morsel::Study
{
  /// Rates of the errors over the resolution, by series, quantity and the
  /// values of the axes that the resolution does not name (draws are taken
  /// together).
  nlohmann::ordered_json
  fitted_rates(const Study &study, const std::vector<Row> &rows);


  /// For each quantity with errors and each cost (time, memory, unknowns) the
  /// runs of all series that no other run beats: indices of rows.
  nlohmann::ordered_json
  pareto_fronts(const Study &study, const std::vector<Row> &rows);


  /// Time to reach 10, 3, 1, 0.3, 0.1, 0.03 and 0.01 % by series and quantity.
  nlohmann::ordered_json
  times_to_reach(const Study &study, const std::vector<Row> &rows);


  /// Mean, deviation and extremes of values and errors over draws, by series,
  /// quantity and the values of the other axes.
  nlohmann::ordered_json
  draw_statistics(const Study &study, const std::vector<Row> &rows);
} // namespace Morsel::Study

#endif
