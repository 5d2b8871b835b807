#include <morsel/core/errors.h>
#include <morsel/study/analysis.h>
#include <morsel/study/claims.h>
#include <morsel/study/optional_json.h>
#include <morsel/study/relations.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    /// Whether a run belongs to one of the series (all if none is named) and
    /// has these values of axes.
    bool
    is_picked(const Study                  &study,
              const PlannedRun             &run,
              const std::string            &series,
              const std::vector<AxisValue> &values)
    {
      const std::vector<std::string> names = list_items(series);
      return (names.empty() ||
              std::find(names.begin(),
                        names.end(),
                        study.series[run.series].name) != names.end()) &&
             std::all_of(values.begin(), values.end(), [&](const auto &v) {
               return has_value(run, v.axis, v.value);
             });
    }


    /// What a study finds about a claim.
    struct Finding
    {
      std::optional<double> value;
      double                deviation = 0.;
      unsigned int          count     = 0;
      std::string           note; ///< why there is no value
    };


    Finding
    correlation_found(const Study            &study,
                      const std::vector<Row> &rows,
                      const Claim            &claim)
    {
      const auto relation =
          std::find_if(study.relations.begin(),
                       study.relations.end(),
                       [&](const auto &r) { return r.name == claim.relation; });
      const unsigned int series =
          claim.series.empty() ? 0 : *study.find_series(claim.series);
      const auto found = correlation_of(study, rows, *relation, series);
      if (!found)
        return {std::nullopt, 0., 0, "fewer than three different points"};
      return {found->coefficient, 0., found->n_points, ""};
    }


    Finding
    quantity_found(const Study            &study,
                   const std::vector<Row> &rows,
                   const Claim            &claim)
    {
      const unsigned int       q  = *study.find_quantity(claim.quantity);
      const auto               at = axis_values(study, "", claim.at);
      std::vector<const Row *> picked;
      for (const Row &row : rows)
        if (row.quantities[q].value &&
            is_picked(study, *row.run, claim.series, at))
          picked.push_back(&row);
      if (claim.at.empty())
        {
          double finest = 0.;
          for (const Row *row : picked)
            finest = std::max(finest, row->resolution.value_or(0.));
          picked.erase(std::remove_if(picked.begin(),
                                      picked.end(),
                                      [&](const Row *row) {
                                        return row->resolution.value_or(0.) <
                                               finest;
                                      }),
                       picked.end());
        }
      if (picked.empty())
        return {std::nullopt, 0., 0, "no such run has finished"};
      std::vector<double> values;
      for (const Row *row : picked)
        {
          if (setting_of(study, *row->run) !=
              setting_of(study, *picked.front()->run))
            return {std::nullopt,
                    0.,
                    0,
                    "several runs have the largest resolution; 'At' must say "
                    "which is meant"};
          values.push_back(*row->quantities[q].value);
        }
      const Statistics s = statistics_of(values);
      return {s.mean, s.sd, s.n, ""};
    }
  } // namespace


  ordered_json
  claims_json(const Study &study, const std::vector<Row> &rows)
  {
    ordered_json list = ordered_json::array();
    for (const Claim &claim : study.claims)
      {
        const auto stated = number_in(claim.value);
        Finding    found;
        if (!claim.relation.empty())
          found = correlation_found(study, rows, claim);
        else if (!claim.quantity.empty())
          found = quantity_found(study, rows, claim);
        const bool comparable = stated && found.value && *stated != 0.;
        list.push_back({{"name", claim.name},
                        {"source", claim.source},
                        {"says", claim.says},
                        {"stated", json_of(stated)},
                        {"ours", json_of(found.value)},
                        {"ours_deviation",
                         found.count > 1 && claim.relation.empty()
                             ? ordered_json(found.deviation)
                             : ordered_json(nullptr)},
                        {"count", found.count},
                        {"difference",
                         comparable ? ordered_json(*found.value / *stated - 1.)
                                    : ordered_json(nullptr)},
                        {"quantity", claim.quantity},
                        {"relation", claim.relation},
                        {"series", claim.series},
                        {"at", claim.at},
                        {"finding", claim.finding},
                        {"note", found.note},
                        {"why", claim.why}});
      }
    return list;
  }


  ordered_json
  figures_json(const Study &study, const std::vector<Row> &rows)
  {
    ordered_json list = ordered_json::array();
    for (const Figure &figure : study.figures)
      {
        const auto   where = axis_values(study, "", figure.where);
        ordered_json runs  = ordered_json::array();
        for (unsigned int r = 0; r < rows.size(); ++r)
          if (rows[r].record->state == Record::State::finished &&
              is_picked(study, *rows[r].run, figure.series, where))
            runs.push_back(r);
        list.push_back({{"name", figure.name},
                        {"kind", figure.kind},
                        {"title", figure.title},
                        {"caption", figure.caption},
                        {"x", figure.x},
                        {"y", list_items(figure.y)},
                        {"picture", figure.picture},
                        {"runs", runs}});
      }
    return list;
  }


  void
  check_claims(const Study &study, const std::vector<PlannedRun> &runs)
  {
    // A quick study need not have the runs that claims are about.
    if (study.quick)
      return;
    for (const Claim &claim : study.claims)
      {
        if (claim.at.empty())
          continue;
        const std::string path  = "Claim " + claim.name + "/At";
        const auto        at    = axis_values(study, path, claim.at);
        const PlannedRun *first = nullptr;
        for (const PlannedRun &run : runs)
          if (is_picked(study, run, claim.series, at))
            {
              if (first == nullptr)
                first = &run;
              else if (setting_of(study, run) != setting_of(study, *first))
                throw InputError(study.place_of(path) + " = '" + claim.at +
                                 "' means several runs, '" + first->label +
                                 "' and '" + run.label +
                                 "' among them; name more axes.");
            }
        if (first == nullptr)
          throw InputError(study.place_of(path) + " = '" + claim.at +
                           "': no run has these values.");
      }
  }
} // namespace Morsel::Study
