#ifndef morsel_study_study_h
#define morsel_study_study_h

#include <morsel/core/parameters.h>

#include <optional>
#include <string>
#include <vector>

namespace Morsel::Study
{
  /// One thing that a study varies: section "Axis <name>".
  struct Axis
  {
    std::string  name; ///< an identifier: formulas may use it
    std::string  label;
    std::string  unit = "1";
    std::string  kind = "numbers";
    std::string  values;
    double       from  = 0.;
    double       to    = 0.;
    unsigned int count = 0;
    unsigned int seed  = 1;
    bool         whole = false;
    std::string  partner;
    std::string  entries;
    std::string  quick_values;
    unsigned int quick_count = 0;

    /// Whether its values are draws, over which one averages.
    bool
    is_random() const
    {
      return kind == "random" || kind == "seeds";
    }
  };


  /// One method, or one base scene, of a study: section "Series <name>".
  struct Series
  {
    std::string name;
    std::string title;
    std::string base_scene; ///< resolved: relative to the working folder
    std::string axes;       ///< names, separated by commas; empty: all
    std::string entries;
    std::string quick_entries;
  };


  /// One result that a study records: listed in 'Quantities', or with a section
  /// "Quantity <name>".
  struct Quantity
  {
    std::string name;
    std::string label;
    std::string unit;
    std::string expression;
    std::string truth = "none";
    std::string truth_formula;
    std::string truth_axis;
    std::string truth_table;
    double      accuracy = 0.; ///< relative, of the truth
    double      scale    = 0.; ///< of errors; 0: the truth's size
    bool        drawn    = true;
  };


  /// How one quantity goes with another, draws averaged: section "Relation
  /// <name>".
  struct Relation
  {
    std::string  name;
    std::string  label;
    std::string  x, y;
    std::string  expected_correlation; ///< a number, or empty
    unsigned int expected_points = 0;  ///< 0: not known
    std::string  source;
  };


  /// What a publication states, beside what the study finds: section "Claim
  /// <name>".
  struct Claim
  {
    std::string name;
    std::string source;
    std::string says;
    std::string value;    ///< a number, or empty
    std::string quantity; ///< what ours is, in ...
    std::string relation; ///< or the correlation of this relation, in ...
    std::string series;   ///< ... this series ...
    std::string at;       ///< ... at these values of axes
    std::string finding;
    std::string why;
  };


  /// An entry that is varied by itself, all others as they are: section
  /// "Sensitivity <name>".
  struct Sensitivity
  {
    std::string name;
    std::string label;
    std::string entries; ///< as those of an axis
    double      low      = 0.;
    double      high     = 0.;
    bool        relative = false;  ///< low and high are multiples of the base
    std::string base;              ///< a number, or empty: the scene's
    bool        numerical = false; ///< no property of what is simulated
    std::string series;            ///< names, separated by commas; empty: all
  };


  /// A figure of what the runs left: section "Figure <name>".
  struct Figure
  {
    std::string name;
    std::string kind = "history";
    std::string title;
    std::string caption;
    std::string x, y;    ///< heads of columns of history.csv
    std::string picture; ///< name of a figure of the runs' own reports
    std::string series;  ///< names, separated by commas; empty: all
    std::string where;   ///< values of axes
  };


  /// The description of a study, constant once read.
  struct Study
  {
    std::string  file; ///< where it was read
    std::string  name;
    std::string  title;
    std::string  base_scene;
    std::string  recorded; ///< names of quantities, separated by commas
    std::string  resolution = "unknowns";
    std::string  resolution_label;
    std::string  time_result  = "wall_time_loop";
    bool         timing       = false;
    unsigned int repetitions  = 1;
    unsigned int side_by_side = 1;
    unsigned int threads      = 1;
    double       time_limit   = 0.; ///< [s], 0: none
    bool         keep_fields  = false;
    bool         quick        = false;
    /// What numerical entries may change at most [1].
    double numerical_bound = 0.03;

    std::vector<Axis>        axes;
    std::vector<Series>      series; ///< at least one
    std::vector<Quantity>    quantities;
    std::vector<Relation>    relations;
    std::vector<Claim>       claims;
    std::vector<Figure>      figures;
    std::vector<Sensitivity> sensitivities;

    /// Where each entry stands, for messages.
    std::vector<ParameterEntry> entries;
    /// All parameters, as used.prm holds them.
    std::string used_parameters;

    const Axis *
    find_axis(const std::string &axis_name) const;

    /// Index in quantities.
    std::optional<unsigned int>
    find_quantity(const std::string &quantity_name) const;

    /// Index in series.
    std::optional<unsigned int>
    find_series(const std::string &series_name) const;

    /// "study.prm:12: 'Axis n/Values'", the beginning of a message.
    std::string
    place_of(const std::string &path) const;
  };


  /// Values of axes that pick runs: "n = 60; food = peanut".
  struct AxisValue
  {
    std::string axis;
    std::string value;
  };


  /// Reads such a text.
  /// @param path of the entry, for messages
  /// @throw InputError if it has another form or names no axis of the study
  std::vector<AxisValue>
  axis_values(const Study       &study,
              const std::string &path,
              const std::string &text);


  /// Whether the parameter file sets anything in this section.
  bool
  has_section(const std::string &file_name, const std::string &section);


  /// Whether the file is a study: it has a section "Study".
  bool
  is_study(const std::string &file_name);


  /// Reads and checks a study; base scenes are looked for from its folder.
  /// @param overrides entries "Section/Key=value" that go before the file's.
  /// @throw InputError with a sentence for every mistake that shows without
  ///   looking into the base scenes.
  Study
  read_study(const std::string              &file_name,
             const std::vector<std::string> &overrides = {});


  /// Every parameter of the study ("prm", "json" or "md").
  std::string
  study_parameters(const std::string              &format,
                   const std::string              &file_name,
                   const std::vector<std::string> &overrides);


  /// The items of a list, trimmed: separated by ';' where there is one, else
  /// by ','. An empty text has no items.
  std::vector<std::string>
  list_items(const std::string &text);
} // namespace Morsel::Study

#endif
