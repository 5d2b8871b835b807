#include <morsel/core/build.h>
#include <morsel/study/claims.h>
#include <morsel/study/findings.h>
#include <morsel/study/optional_json.h>
#include <morsel/study/relations.h>
#include <morsel/study/results.h>
#include <morsel/study/sensitivity.h>

#include <nlohmann/json.hpp>

#include <sstream>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    /// Unit and meaning of a quantity: its own, or those of the result.
    Result
    description_of(const Quantity &quantity, const std::vector<Row> &rows)
    {
      Result description;
      description.unit = "1";
      for (const Row &row : rows)
        {
          const auto result = row.record->results.find(quantity.expression);
          if (result == row.record->results.end())
            continue;
          description = result->second;
          break;
        }
      if (description.meaning.empty())
        description.meaning = quantity.expression;
      if (!quantity.unit.empty())
        description.unit = quantity.unit;
      return description;
    }


    ordered_json
    axes_json(const Study &study)
    {
      ordered_json axes = ordered_json::object();
      for (const Axis &axis : study.axes)
        axes[axis.name] = {{"label", axis.label},
                           {"unit", axis.unit},
                           {"kind", axis.kind},
                           {"together_with", axis.partner}};
      return axes;
    }


    ordered_json
    series_json(const Study &study)
    {
      ordered_json list = ordered_json::array();
      for (const Series &series : study.series)
        list.push_back({{"name", series.name},
                        {"title", series.title},
                        {"base_scene", series.base_scene}});
      return list;
    }


    ordered_json
    quantities_json(const Study &study, const std::vector<Row> &rows)
    {
      ordered_json quantities = ordered_json::object();
      for (const Quantity &quantity : study.quantities)
        {
          const Result description  = description_of(quantity, rows);
          quantities[quantity.name] = {
              {"label", quantity.label},
              {"unit", description.unit},
              {"meaning", description.meaning},
              {"truth", quantity.truth},
              {"truth_formula", quantity.truth_formula},
              {"truth_accuracy", quantity.accuracy},
              {"error_scale", quantity.scale},
              {"drawn", quantity.drawn}};
        }
      return quantities;
    }


    ordered_json
    run_json(const Study &study, const Row &row)
    {
      ordered_json axes = ordered_json::object();
      for (const Axis &axis : study.axes)
        if (const auto text = row.run->texts.find(axis.name);
            text != row.run->texts.end())
          {
            const auto number = row.run->numbers.find(axis.name);
            axes[axis.name]   = number == row.run->numbers.end()
                                    ? ordered_json(text->second)
                                    : ordered_json(number->second);
          }
      ordered_json quantities = ordered_json::object();
      for (unsigned int q = 0; q < study.quantities.size(); ++q)
        quantities[study.quantities[q].name] = {
            {"value", json_of(row.quantities[q].value)},
            {"truth", json_of(row.quantities[q].truth)},
            {"error", json_of(row.quantities[q].error)}};
      return {{"series", study.series[row.run->series].name},
              {"axes", axes},
              {"variation", variation_json(*row.run)},
              {"status", name_of(row.record->state)},
              {"message", row.record->message},
              {"kept", row.record->kept},
              {"folder", "runs/" + row.run->folder},
              {"resolution", json_of(row.resolution)},
              {"quantities", quantities},
              {"time", json_of(row.time)},
              {"time_low", json_of(row.time_low)},
              {"time_high", json_of(row.time_high)},
              {"repetitions", row.record->times.size()},
              {"wall_time", row.record->wall_time},
              {"cpu_time", row.record->cpu_time},
              {"memory", json_of(row.memory)},
              {"unknowns", json_of(row.unknowns)}};
    }


    std::string
    cell(const std::string &text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      std::string quoted = "\"";
      for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
      return quoted + "\"";
    }


    std::string
    cell(const std::optional<double> &value)
    {
      return value ? value_text(*value) : "";
    }


    std::string
    header(const Study &study, const std::vector<Row> &rows)
    {
      std::string text = "series";
      if (!study.sensitivities.empty())
        text += ",variation";
      for (const Axis &axis : study.axes)
        text += "," + cell(axis.name + " [" + axis.unit + "]");
      text += ",status,resolution [1]";
      for (const Quantity &quantity : study.quantities)
        {
          const std::string unit =
              " [" + description_of(quantity, rows).unit + "]";
          text += "," + cell(quantity.name + unit) + "," +
                  cell(quantity.name + "_truth" + unit) + "," +
                  cell(quantity.name + "_error [1]");
        }
      return text + ",time [s],time_low [s],time_high [s],repetitions [1],"
                    "wall_time [s],cpu_time [s],memory [B],unknowns [1],"
                    "folder,message\n";
    }
  } // namespace


  std::string
  study_csv(const Study &study, const std::vector<Row> &rows)
  {
    std::ostringstream out;
    out << header(study, rows);
    for (const Row &row : rows)
      {
        const Record &record = *row.record;
        out << cell(study.series[row.run->series].name);
        if (!study.sensitivities.empty())
          out << ',' << cell(variation_text(*row.run));
        for (const Axis &axis : study.axes)
          {
            const auto text = row.run->texts.find(axis.name);
            out << ','
                << (text == row.run->texts.end() ? "" : cell(text->second));
          }
        out << ',' << name_of(record.state) << ',' << cell(row.resolution);
        for (const Measured &m : row.quantities)
          out << ',' << cell(m.value) << ',' << cell(m.truth) << ','
              << cell(m.error);
        out << ',' << cell(row.time) << ',' << cell(row.time_low) << ','
            << cell(row.time_high) << ',' << record.times.size() << ','
            << record.wall_time << ',' << record.cpu_time << ','
            << cell(row.memory) << ',' << cell(row.unknowns) << ",runs/"
            << cell(row.run->folder) << ',' << cell(record.message) << '\n';
      }
    return out.str();
  }


  ordered_json
  study_json(const Study &study, const std::vector<Row> &rows)
  {
    ordered_json     runs = ordered_json::array();
    std::vector<Row> base;
    for (const Row &row : rows)
      {
        runs.push_back(run_json(study, row));
        // They come first, so that their indices hold.
        if (row.run->sensitivity.empty())
          base.push_back(row);
      }
    return {{"name", study.name},
            {"title", study.title},
            {"study", study.file},
            {"program_version", MORSEL_VERSION},
            {"quick", study.quick},
            {"timing", study.timing},
            {"threads", study.threads},
            {"resolution",
             {{"formula", study.resolution},
              {"label",
               study.resolution_label.empty() ? study.resolution
                                              : study.resolution_label}}},
            {"time",
             {{"result", study.time_result},
              {"unit", "s"},
              {"meaning",
               "median over the repetitions; time_low and time_high are the "
               "extremes, wall_time and cpu_time those of the last process "
               "as a whole"}}},
            {"axes", axes_json(study)},
            {"series", series_json(study)},
            {"quantities", quantities_json(study, rows)},
            {"runs", runs},
            {"rates", fitted_rates(study, base)},
            {"pareto_fronts", pareto_fronts(study, base)},
            {"time_to_reach", times_to_reach(study, base)},
            {"statistics", draw_statistics(study, base)},
            {"relations", relations_json(study, base)},
            {"claims", claims_json(study, base)},
            {"figures", figures_json(study, base)},
            {"sensitivities", sensitivities_json(study)},
            {"sensitivity_changes", sensitivity_changes(study, rows)}};
  }
} // namespace Morsel::Study
