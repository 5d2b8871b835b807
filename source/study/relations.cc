#include <morsel/study/analysis.h>
#include <morsel/study/optional_json.h>
#include <morsel/study/relations.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    /// Sets name_low and name_high.
    void
    set_interval(ordered_json                  &json,
                 const std::string             &name,
                 const std::optional<Interval> &interval)
    {
      json[name + "_low"]  = interval ? ordered_json(interval->low) : nullptr;
      json[name + "_high"] = interval ? ordered_json(interval->high) : nullptr;
    }


    /// "soft nut", or "n = 5, a = 0.1" where no axis holds texts.
    std::string
    label_of(const Study &study, const PlannedRun &run)
    {
      std::string texts, numbers;
      for (const Axis &axis : study.axes)
        if (const auto value = run.texts.find(axis.name);
            value != run.texts.end() && axis.partner.empty() &&
            !axis.is_random())
          {
            std::string &list = axis.kind == "texts" ? texts : numbers;
            list += (list.empty() ? "" : ", ") +
                    (axis.kind == "texts" ? "" : axis.label + " = ") +
                    value->second;
          }
      return texts.empty() ? numbers : texts;
    }


    struct Points
    {
      std::vector<double>      x, y;
      std::vector<Statistics>  x_draws, y_draws;
      std::vector<std::string> labels;
    };


    /// One point for each setting of a series: the means of its draws.
    Points
    points_of(const Study            &study,
              const std::vector<Row> &rows,
              const unsigned int      series,
              const unsigned int      qx,
              const unsigned int      qy)
    {
      struct Sample
      {
        std::string         label;
        std::vector<double> x, y;
      };
      std::vector<std::map<std::string, std::string>> settings;
      std::vector<Sample>                             samples;
      for (const Row &row : rows)
        {
          if (row.run->series != series || !row.quantities[qx].value ||
              !row.quantities[qy].value)
            continue;
          const auto setting = setting_of(study, *row.run);
          const auto known =
              std::find(settings.begin(), settings.end(), setting);
          const std::size_t k = known - settings.begin();
          if (known == settings.end())
            {
              settings.push_back(setting);
              samples.push_back({label_of(study, *row.run), {}, {}});
            }
          samples[k].x.push_back(*row.quantities[qx].value);
          samples[k].y.push_back(*row.quantities[qy].value);
        }
      Points points;
      for (const Sample &sample : samples)
        {
          points.labels.push_back(sample.label);
          points.x_draws.push_back(statistics_of(sample.x));
          points.y_draws.push_back(statistics_of(sample.y));
          points.x.push_back(points.x_draws.back().mean);
          points.y.push_back(points.y_draws.back().mean);
        }
      return points;
    }


    ordered_json
    points_json(const Points &points)
    {
      ordered_json list = ordered_json::array();
      for (std::size_t i = 0; i < points.x.size(); ++i)
        list.push_back({{"x", points.x[i]},
                        {"y", points.y[i]},
                        {"count", points.y_draws[i].n},
                        {"x_deviation", points.x_draws[i].sd},
                        {"y_deviation", points.y_draws[i].sd},
                        {"label", points.labels[i]}});
      return list;
    }


    Points
    points_of(const Study            &study,
              const std::vector<Row> &rows,
              const Relation         &relation,
              const unsigned int      series)
    {
      return points_of(study,
                       rows,
                       series,
                       *study.find_quantity(relation.x),
                       *study.find_quantity(relation.y));
    }


    ordered_json
    group_json(const Relation    &relation,
               const std::string &series,
               const Points      &points)
    {
      const auto   correlation = correlate(points.x, points.y);
      const auto   line        = fit_line(points.x, points.y);
      ordered_json json        = {{"series", series},
                                  {"points", points_json(points)},
                                  {"count", points.x.size()}};
      json["correlation"] =
          correlation ? ordered_json(correlation->coefficient) : nullptr;
      set_interval(json,
                   "correlation",
                   correlation ? correlation->interval : std::nullopt);
      json["p_value"] =
          correlation ? ordered_json(correlation->p_value) : nullptr;
      json["slope"] = line ? ordered_json(line->slope) : nullptr;
      set_interval(json, "slope", line ? line->slope_interval : std::nullopt);
      json["intercept"]   = line ? ordered_json(line->intercept) : nullptr;
      const auto expected = number_in(relation.expected_correlation);
      json["expected_p_value"] =
          correlation && expected
              ? json_of(p_of_equal_correlations(correlation->coefficient,
                                                correlation->n_points,
                                                *expected,
                                                relation.expected_points))
              : ordered_json(nullptr);
      return json;
    }


    ordered_json
    relation_json(const Study            &study,
                  const std::vector<Row> &rows,
                  const Relation         &relation)
    {
      ordered_json                              groups = ordered_json::array();
      ordered_json                              slopes = ordered_json::array();
      std::vector<std::pair<std::string, Line>> lines;
      for (unsigned int s = 0; s < study.series.size(); ++s)
        {
          const Points points = points_of(study, rows, relation, s);
          if (points.x.empty())
            continue;
          const std::string &name = study.series[s].name;
          groups.push_back(group_json(relation, name, points));
          const auto line = fit_line(points.x, points.y);
          if (!line)
            continue;
          for (const auto &[other, other_line] : lines)
            slopes.push_back(
                {{"first", other},
                 {"second", name},
                 {"difference", line->slope - other_line.slope},
                 {"p_value", json_of(p_of_equal_slopes(other_line, *line))}});
          lines.emplace_back(name, *line);
        }
      return {{"name", relation.name},
              {"label", relation.label},
              {"x", relation.x},
              {"y", relation.y},
              {"expected_correlation",
               json_of(number_in(relation.expected_correlation))},
              {"expected_points", relation.expected_points},
              {"source", relation.source},
              {"groups", groups},
              {"slopes", slopes}};
    }


  } // namespace


  ordered_json
  relations_json(const Study &study, const std::vector<Row> &rows)
  {
    ordered_json list = ordered_json::array();
    for (const Relation &relation : study.relations)
      list.push_back(relation_json(study, rows, relation));
    return list;
  }


  std::optional<Correlation>
  correlation_of(const Study            &study,
                 const std::vector<Row> &rows,
                 const Relation         &relation,
                 const unsigned int      series)
  {
    const Points points = points_of(study, rows, relation, series);
    return correlate(points.x, points.y);
  }
} // namespace Morsel::Study
