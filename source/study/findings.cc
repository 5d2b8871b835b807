#include <morsel/study/analysis.h>
#include <morsel/study/findings.h>
#include <morsel/study/optional_json.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    using AxisValues = std::map<std::string, std::string>;

    /// Rows of one series with the same values of some axes.
    using Groups =
        std::map<std::pair<unsigned int, AxisValues>, std::vector<const Row *>>;


    /// @param separated whether runs that differ in this axis are kept apart
    template <typename Predicate>
    Groups
    group(const Study            &study,
          const std::vector<Row> &rows,
          const Predicate        &separated)
    {
      Groups groups;
      for (const Row &row : rows)
        {
          AxisValues values;
          for (const auto &[name, text] : row.run->texts)
            if (separated(*study.find_axis(name)))
              values[name] = text;
          groups[{row.run->series, values}].push_back(&row);
        }
      return groups;
    }


    /// An error that says something: not below the truth's own.
    bool
    is_significant(const Quantity &quantity, const Measured &measured)
    {
      return measured.error && std::abs(*measured.error) > quantity.accuracy;
    }


    /// How good a run is known to be: never better than the truth.
    double
    known_error(const Quantity &quantity, const Measured &measured)
    {
      return std::max(std::abs(*measured.error), quantity.accuracy);
    }


    struct CostKind
    {
      const char           *name;
      std::optional<double> Row::*const member;
    };

    const std::array<CostKind, 3> cost_kinds = {{{"time", &Row::time},
                                                 {"memory", &Row::memory},
                                                 {"unknowns", &Row::unknowns}}};


    ordered_json
    json_of(const Statistics &s)
    {
      return {{"count", s.n},
              {"mean", s.mean},
              {"standard_deviation", s.sd},
              {"median", s.median},
              {"smallest", s.low},
              {"largest", s.high}};
    }
  } // namespace


  ordered_json
  fitted_rates(const Study &study, const std::vector<Row> &rows)
  {
    const auto names   = names_in(study.resolution);
    bool       by_axis = false;
    for (const std::string &name : names)
      by_axis = by_axis || study.find_axis(name) != nullptr;
    // A resolution that is a result says not which axis makes it.
    const Groups groups = group(study, rows, [&](const Axis &axis) {
      return by_axis && !axis.is_random() && names.count(axis.name) == 0 &&
             (axis.partner.empty() || names.count(axis.partner) == 0);
    });

    ordered_json fits = ordered_json::array();
    for (unsigned int q = 0; q < study.quantities.size(); ++q)
      for (const auto &[key, members] : groups)
        {
          std::vector<double> resolution, error;
          for (const Row *row : members)
            if (row->resolution &&
                is_significant(study.quantities[q], row->quantities[q]))
              {
                resolution.push_back(*row->resolution);
                error.push_back(std::abs(*row->quantities[q].error));
              }
          if (const auto fit = fit_rate(resolution, error))
            fits.push_back({{"quantity", study.quantities[q].name},
                            {"series", study.series[key.first].name},
                            {"at", key.second},
                            {"rate", fit->rate},
                            {"low", json_of(fit->low)},
                            {"high", json_of(fit->high)},
                            {"constant", fit->constant},
                            {"points", fit->n_points}});
        }
    return fits;
  }


  ordered_json
  pareto_fronts(const Study &study, const std::vector<Row> &rows)
  {
    ordered_json fronts = ordered_json::array();
    for (unsigned int q = 0; q < study.quantities.size(); ++q)
      for (const CostKind &kind : cost_kinds)
        {
          std::vector<double>       cost, error;
          std::vector<unsigned int> index;
          for (unsigned int r = 0; r < rows.size(); ++r)
            if (rows[r].*kind.member && rows[r].quantities[q].error)
              {
                cost.push_back(*(rows[r].*kind.member));
                error.push_back(
                    known_error(study.quantities[q], rows[r].quantities[q]));
                index.push_back(r);
              }
          ordered_json members = ordered_json::array();
          for (const unsigned int i : pareto_front(cost, error))
            members.push_back(index[i]);
          if (!members.empty())
            fronts.push_back({{"quantity", study.quantities[q].name},
                              {"cost", kind.name},
                              {"runs", members}});
        }
    return fronts;
  }


  ordered_json
  times_to_reach(const Study &study, const std::vector<Row> &rows)
  {
    constexpr std::array<double, 7> levels = {
        {0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001}};
    ordered_json table = ordered_json::array();
    const Groups groups =
        group(study, rows, [](const Axis &) { return false; });
    for (unsigned int q = 0; q < study.quantities.size(); ++q)
      for (const auto &[key, members] : groups)
        {
          std::vector<double> time, error;
          for (const Row *row : members)
            if (row->time && *row->time > 0. && row->quantities[q].error)
              {
                time.push_back(*row->time);
                error.push_back(
                    known_error(study.quantities[q], row->quantities[q]));
              }
          if (time.empty())
            continue;
          ordered_json reached = ordered_json::array();
          for (const double level : levels)
            {
              const CostToReach cost = cost_to_reach(time, error, level);
              using Kind             = CostToReach::Kind;
              reached.push_back(
                  {{"error", level},
                   {"kind",
                    cost.kind == Kind::not_reached ? "not reached"
                    : cost.kind == Kind::at_most   ? "at most"
                                                   : "interpolated"},
                   {"time",
                    cost.kind == Kind::not_reached ? ordered_json(nullptr)
                                                   : ordered_json(cost.cost)}});
            }
          table.push_back({{"quantity", study.quantities[q].name},
                           {"series", study.series[key.first].name},
                           {"levels", reached}});
        }
    return table;
  }


  ordered_json
  draw_statistics(const Study &study, const std::vector<Row> &rows)
  {
    const Groups groups =
        group(study, rows, [](const Axis &axis) { return !axis.is_random(); });
    ordered_json table = ordered_json::array();
    for (unsigned int q = 0; q < study.quantities.size(); ++q)
      for (const auto &[key, members] : groups)
        {
          bool drawn = false;
          for (const auto &axis_value : members.front()->run->texts)
            drawn = drawn || study.find_axis(axis_value.first)->is_random();
          std::vector<double> values, errors;
          for (const Row *row : members)
            {
              if (row->quantities[q].value)
                values.push_back(*row->quantities[q].value);
              if (row->quantities[q].error)
                errors.push_back(*row->quantities[q].error);
            }
          if (!drawn || values.empty())
            continue;
          table.push_back({{"quantity", study.quantities[q].name},
                           {"series", study.series[key.first].name},
                           {"at", key.second},
                           {"value", json_of(statistics_of(values))}});
          if (errors.empty())
            continue;
          table.back()["error"] = json_of(statistics_of(errors));
          for (double &error : errors)
            error = std::abs(error);
          table.back()["absolute_error"] = json_of(statistics_of(errors));
        }
    return table;
  }
} // namespace Morsel::Study
