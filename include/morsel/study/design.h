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

    /// What is varied beside the axes; empty: nothing, the run is a base.
    std::string sensitivity;
    std::string side;        ///< "low" or "high"
    double      varied = 0.; ///< its value [unit of the entry]

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


  /// "Section/Key = text; Section/Key" as overrides, formulas filled in.
  /// @param path of the entry that holds the text, for messages
  /// @param value what items without text get; nullptr: there must be none
  /// @throw InputError
  std::vector<std::string>
  overrides_of(const Study       &study,
               const std::string &path,
               const std::string &entries,
               const PlannedRun  &run,
               const std::string *value);


  /// A name for the folder of a run that any file system takes, with a hash
  /// that makes it unique.
  std::string
  folder_name(const PlannedRun &run);


  /// All runs: for each series the product of its axes, of which the first
  /// varies slowest; an axis that goes together with another one adds no
  /// factor. After them the variations of each for the sensitivities.
  /// @throw InputError for an axis without values, partners of different
  ///   length, formulas that are not understood
  std::vector<PlannedRun>
  plan_runs(const Study &study);
} // namespace Morsel::Study

#endif
