#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/analysis.h>
#include <morsel/study/optional_json.h>
#include <morsel/study/sensitivity.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    bool
    concerns(const Sensitivity &sensitivity, const Series &series)
    {
      const std::vector<std::string> names = list_items(sensitivity.series);
      return names.empty() ||
             std::find(names.begin(), names.end(), series.name) != names.end();
    }


    /// The base scene's value of what is varied.
    double
    base_value(const Study       &study,
               const Sensitivity &sensitivity,
               const PlannedRun  &run)
    {
      if (!sensitivity.base.empty())
        return *number_in(sensitivity.base);
      const std::string first = list_items(sensitivity.entries + ";").front();
      const std::string path =
          fill_in(trimmed(first.substr(0, first.find('='))),
                  run.numbers,
                  {{"series", study.series[run.series].name}});
      const auto values =
          scene_values(study.series[run.series].base_scene, run.overrides);
      const auto value = values.find(path);
      if (value == values.end() || !number_in(value->second))
        throw InputError(
            study.place_of("Sensitivity " + sensitivity.name + "/Relative") +
            ": '" + path + "' is no number in the base scene of '" +
            study.series[run.series].name +
            "'; give 'Base', or absolute values of 'Low' and 'High'.");
      return *number_in(value->second);
    }


    PlannedRun
    variation_of(const Study       &study,
                 const Sensitivity &sensitivity,
                 const PlannedRun  &base,
                 const bool         is_low)
    {
      PlannedRun run  = base;
      run.sensitivity = sensitivity.name;
      run.side        = is_low ? "low" : "high";
      run.varied      = is_low ? sensitivity.low : sensitivity.high;
      if (sensitivity.relative)
        run.varied *= base_value(study, sensitivity, base);
      const std::string text       = value_text(run.varied);
      PlannedRun        with_value = run;
      with_value.numbers["value"]  = run.varied;
      for (const std::string &entry :
           overrides_of(study,
                        "Sensitivity " + sensitivity.name + "/Entries",
                        sensitivity.entries,
                        with_value,
                        &text))
        run.overrides.push_back(entry);
      run.label += ", " + variation_text(run);
      run.folder = folder_name(run);
      return run;
    }


    /// The draws of one series and setting, and their variations.
    struct Group
    {
      unsigned int                       series;
      std::map<std::string, std::string> setting;
      std::vector<const Row *>           base, varied;
    };


    std::vector<Group>
    groups_of(const Study &study, const std::vector<Row> &rows)
    {
      std::vector<Group> groups;
      for (const Row &row : rows)
        {
          const auto setting = setting_of(study, *row.run);
          auto       group =
              std::find_if(groups.begin(), groups.end(), [&](const Group &g) {
                return g.series == row.run->series && g.setting == setting;
              });
          if (group == groups.end())
            group = groups.insert(group, {row.run->series, setting, {}, {}});
          (row.run->sensitivity.empty() ? group->base : group->varied)
              .push_back(&row);
        }
      return groups;
    }


    /// The change of a quantity at one end of a variation, or null.
    ordered_json
    change_json(const Group       &group,
                const Sensitivity &sensitivity,
                const std::string &side,
                const unsigned int q)
    {
      std::vector<double> base, differences;
      double              value = 0.;
      for (const Row *row : group.varied)
        if (row->run->sensitivity == sensitivity.name &&
            row->run->side == side && row->quantities[q].value)
          for (const Row *other : group.base)
            if (other->run->texts == row->run->texts &&
                other->quantities[q].value)
              {
                base.push_back(*other->quantities[q].value);
                differences.push_back(*row->quantities[q].value - base.back());
                value = row->run->varied;
              }
      if (base.empty())
        return nullptr;
      const double     scale = std::abs(statistics_of(base).mean);
      const Statistics s     = statistics_of(differences);
      if (!(scale > 0.))
        return nullptr;
      return {{"value", value},
              {"change", s.mean / scale},
              {"standard_error",
               s.n > 1 ? ordered_json(s.sd / std::sqrt(s.n) / scale)
                       : ordered_json(nullptr)},
              {"count", s.n}};
    }


    double
    size_of(const ordered_json &change)
    {
      return change.is_null() ? 0. : std::abs(change["change"].get<double>());
    }


    /// All changes of one quantity in one group, the largest first.
    std::vector<ordered_json>
    changes_of(const Study &study, const Group &group, const unsigned int q)
    {
      std::vector<ordered_json> list;
      for (const Sensitivity &sensitivity : study.sensitivities)
        {
          const ordered_json low  = change_json(group, sensitivity, "low", q);
          const ordered_json high = change_json(group, sensitivity, "high", q);
          if (low.is_null() && high.is_null())
            continue;
          const double size = std::max(size_of(low), size_of(high));
          list.push_back(
              {{"quantity", study.quantities[q].name},
               {"series", study.series[group.series].name},
               {"at", group.setting},
               {"sensitivity", sensitivity.name},
               {"low", low},
               {"high", high},
               {"size", size},
               {"beyond_bound",
                sensitivity.numerical && size > study.numerical_bound}});
        }
      std::stable_sort(
          list.begin(), list.end(), [](const auto &a, const auto &b) {
            return a["size"].template get<double>() >
                   b["size"].template get<double>();
          });
      return list;
    }
  } // namespace


  void
  append_variations(const Study &study, std::vector<PlannedRun> &runs)
  {
    const unsigned int n_base = runs.size();
    for (const Sensitivity &sensitivity : study.sensitivities)
      for (unsigned int r = 0; r < n_base; ++r)
        if (concerns(sensitivity, study.series[runs[r].series]))
          for (const bool is_low : {true, false})
            runs.push_back(variation_of(study, sensitivity, runs[r], is_low));
  }


  std::string
  variation_text(const PlannedRun &run)
  {
    return run.sensitivity.empty()
               ? ""
               : run.sensitivity + " = " + value_text(run.varied);
  }


  ordered_json
  variation_json(const PlannedRun &run)
  {
    if (run.sensitivity.empty())
      return nullptr;
    return {{"sensitivity", run.sensitivity},
            {"side", run.side},
            {"value", run.varied}};
  }


  ordered_json
  sensitivities_json(const Study &study)
  {
    ordered_json list = ordered_json::array();
    for (const Sensitivity &s : study.sensitivities)
      list.push_back({{"name", s.name},
                      {"label", s.label},
                      {"entries", s.entries},
                      {"low", s.low},
                      {"high", s.high},
                      {"relative", s.relative},
                      {"numerical", s.numerical},
                      {"bound",
                       s.numerical ? ordered_json(study.numerical_bound)
                                   : ordered_json(nullptr)}});
    return list;
  }


  ordered_json
  sensitivity_changes(const Study &study, const std::vector<Row> &rows)
  {
    ordered_json list = ordered_json::array();
    if (study.sensitivities.empty())
      return list;
    const std::vector<Group> groups = groups_of(study, rows);
    for (unsigned int q = 0; q < study.quantities.size(); ++q)
      for (const Group &group : groups)
        for (const ordered_json &change : changes_of(study, group, q))
          list.push_back(change);
    return list;
  }
} // namespace Morsel::Study
