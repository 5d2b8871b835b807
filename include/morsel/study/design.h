#ifndef morsel_study_design_h
#define morsel_study_design_h

#include <morsel/study/formula.h>
#include <morsel/study/study.h>

#include <map>
#include <string>
#include <vector>

namespace Morsel::Study
{
  /// One run of a study: a scene and what is set in it.
  struct PlannedRun
  {
    unsigned int             series = 0; ///< index in Study::series
    std::vector<std::string> overrides;  ///< "Section/Key=value"

    /// The axes' values by axis name: all as text, numbers as such, too.
    std::map<std::string, std::string> texts;
    Variables                          numbers;

    std::string folder; ///< name of its folder of results, unique

    /// "p1, n = 7", for people.
    std::string label;
  };


  /// Whether the run has this value of an axis: the same number, or text.
  bool
  has_value(const PlannedRun  &run,
            const std::string &axis,
            const std::string &value);


  /// The values of the axes that are no draws: runs that differ in no other
  /// one are draws of the same setting.
  std::map<std::string, std::string>
  setting_of(const Study &study, const PlannedRun &run);


  /// The values of an axis as texts.
  /// @throw InputError if there are none, or one is no number
  std::vector<std::string>
  values_of(const Study &study, const Axis &axis);


  /// All runs: for each series the product of its axes, of which the first
  /// varies slowest; an axis that goes together with another one adds no
  /// factor.
  /// @throw InputError for an axis without values, partners of different
  ///   length, formulas that are not understood
  std::vector<PlannedRun>
  plan_runs(const Study &study);
} // namespace Morsel::Study

#endif
