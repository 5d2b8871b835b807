#ifndef morsel_study_relations_h
#define morsel_study_relations_h

#include <morsel/study/evaluation.h>
#include <morsel/study/regression.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <vector>

namespace Morsel::Study
{
  /// For each relation and series: its points (draws averaged), correlation
  /// and straight line with 95 % intervals, the comparison with the expected
  /// correlation, and of the series' slopes with each other.
  nlohmann::ordered_json
  relations_json(const Study &study, const std::vector<Row> &rows);


  /// The correlation of a relation in a series, draws averaged.
  /// @return nothing for fewer than three different points
  std::optional<Correlation>
  correlation_of(const Study            &study,
                 const std::vector<Row> &rows,
                 const Relation         &relation,
                 unsigned int            series);
} // namespace Morsel::Study

#endif
