#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/analysis.h>
#include <morsel/study/claims.h>
#include <morsel/study/evaluation.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Morsel::Study
{
  namespace
  {
    /// dof_count, or two unknowns a particle.
    std::optional<double>
    unknowns_of(const Results &results)
    {
      if (const auto dofs = results.find("dof_count"); dofs != results.end())
        return dofs->second.value;
      if (const auto n = results.find("particle_count"); n != results.end())
        return 2. * n->second.value;
      return std::nullopt;
    }


    /// All that formulas may use of a finished run.
    Variables
    variables_of(const PlannedRun &run, const Record &record)
    {
      Variables variables = run.numbers;
      for (const auto &[name, result] : record.results)
        variables.emplace(name, result.value);
      if (const auto unknowns = unknowns_of(record.results))
        variables.emplace("unknowns", *unknowns);
      return variables;
    }


    /// The formula's value, or nothing where this run lacks one of its names
    /// or where it is not finite.
    std::optional<double>
    value_of(const std::string &formula, const Variables &variables)
    {
      for (const std::string &name : names_in(formula))
        if (variables.count(name) == 0)
          return std::nullopt;
      const double value = evaluate(formula, variables);
      return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
    }


    /// Whether a key of a truth table stands for this run.
    bool
    matches(const Study       &study,
            const Quantity    &quantity,
            const PlannedRun  &run,
            const std::string &key)
    {
      if (quantity.truth_axis == "series")
        return study.series[run.series].name == key;
      return has_value(run, quantity.truth_axis, key);
    }


    struct TableEntry
    {
      std::string key;
      double      truth;
    };


    std::vector<TableEntry>
    truth_table(const Study &study, const Quantity &quantity)
    {
      std::vector<TableEntry> table;
      for (const std::string &item : list_items(quantity.truth_table))
        {
          const std::size_t colon = item.rfind(':');
          const auto        truth = colon == std::string::npos
                                        ? std::nullopt
                                        : number_in(trimmed(item.substr(colon + 1)));
          if (!truth)
            throw InputError(
                study.place_of("Quantity " + quantity.name + "/Truth table") +
                " has '" + item + "' where 'axis value: number' is needed.");
          table.push_back({trimmed(item.substr(0, colon)), *truth});
        }
      return table;
    }


    /// The truth of a run, unless it is another run.
    std::optional<double>
    stated_truth(const Study      &study,
                 const Quantity   &quantity,
                 const PlannedRun &run,
                 const Record     &record)
    {
      if (quantity.truth == "formula")
        return value_of(quantity.truth_formula, run.numbers);
      if (quantity.truth == "table")
        for (const TableEntry &entry : truth_table(study, quantity))
          if (matches(study, quantity, run, entry.key))
            return entry.truth;
      if (quantity.truth == "reference")
        {
          const auto result = record.results.find(quantity.expression);
          if (result != record.results.end())
            return result->second.reference;
        }
      return std::nullopt;
    }


    /// The values of the axes along which the truth differs.
    std::vector<std::string>
    truth_group(const Quantity &quantity, const PlannedRun &run)
    {
      std::vector<std::string> group;
      for (const std::string &name : list_items(quantity.truth_axis))
        {
          const auto text = run.texts.find(name);
          group.push_back(name == "series"          ? std::to_string(run.series)
                          : text == run.texts.end() ? ""
                                                    : text->second);
        }
      return group;
    }


    /// The finished run of largest resolution whose truth is the same.
    const Row *
    finest_row(const std::vector<Row> &rows,
               const Quantity         &quantity,
               const unsigned int      q,
               const PlannedRun       &run)
    {
      const Row *finest = nullptr;
      const auto group  = truth_group(quantity, run);
      for (const Row &row : rows)
        if (row.run->sensitivity.empty() && row.resolution &&
            row.quantities[q].value &&
            truth_group(quantity, *row.run) == group &&
            (finest == nullptr || *row.resolution > *finest->resolution))
          finest = &row;
      return finest;
    }


    void
    set_errors(const Study &study, std::vector<Row> &rows)
    {
      for (unsigned int q = 0; q < study.quantities.size(); ++q)
        for (Row &row : rows)
          {
            const Quantity &quantity = study.quantities[q];
            Measured       &m        = row.quantities[q];
            if (!m.value)
              continue;
            if (quantity.truth == "finest run")
              {
                const Row *finest = finest_row(rows, quantity, q, *row.run);
                if (finest == nullptr || finest == &row)
                  continue;
                m.truth = finest->quantities[q].value;
              }
            else
              m.truth = stated_truth(study, quantity, *row.run, *row.record);
            if (!m.truth)
              continue;
            const double scale = quantity.scale > 0. ? quantity.scale
                                 : *m.truth != 0.    ? std::abs(*m.truth)
                                                     : 1.;
            m.error            = (*m.value - *m.truth) / scale;
          }
    }


    Row
    row_of(const Study &study, const PlannedRun &run, const Record &record)
    {
      Row row(run, record);
      row.quantities.resize(study.quantities.size());
      if (record.state != Record::State::finished)
        return row;
      const Variables variables = variables_of(run, record);
      for (unsigned int q = 0; q < study.quantities.size(); ++q)
        row.quantities[q].value =
            value_of(study.quantities[q].expression, variables);
      row.resolution = value_of(study.resolution, variables);
      row.unknowns   = unknowns_of(record.results);
      row.memory     = value_of("peak_memory", variables);
      if (!record.times.empty())
        {
          const Statistics times = statistics_of(record.times);
          row.time               = times.median;
          row.time_low           = times.low;
          row.time_high          = times.high;
        }
      return row;
    }


    /// A formula with some number for every name, to see whether it can be
    /// read.
    void
    check_syntax(const Study       &study,
                 const std::string &path,
                 const std::string &formula)
    {
      Variables ones;
      for (const std::string &name : names_in(formula))
        ones[name] = 0.7;
      try
        {
          evaluate(formula, ones);
        }
      catch (const InputError &error)
        {
          throw InputError(study.place_of(path) + ": " + error.what());
        }
    }


    void
    check_truth(const Study                   &study,
                const Quantity                &quantity,
                const std::vector<PlannedRun> &runs)
    {
      const std::string section = "Quantity " + quantity.name + "/";
      if (quantity.truth == "formula")
        for (const PlannedRun &run : runs)
          try
            {
              finite_value(quantity.truth_formula, run.numbers);
            }
          catch (const InputError &error)
            {
              throw InputError(study.place_of(section + "Truth formula") +
                               ": " + error.what());
            }
      // A quick study need not take all values that the table has.
      if (quantity.truth != "table" || study.quick)
        return;
      for (const TableEntry &entry : truth_table(study, quantity))
        if (std::none_of(runs.begin(), runs.end(), [&](const auto &run) {
              return matches(study, quantity, run, entry.key);
            }))
          throw InputError(study.place_of(section + "Truth table") + " has '" +
                           entry.key + "', but no run has this value of '" +
                           quantity.truth_axis + "'.");
    }


    const std::string resolution_entry = "Study/Resolution";


    /// The formulas of results, with the entry that each stands in.
    std::vector<std::pair<std::string, std::string>>
    result_formulas(const Study &study)
    {
      std::vector<std::pair<std::string, std::string>> formulas;
      for (const Quantity &quantity : study.quantities)
        formulas.emplace_back("Quantity " + quantity.name + "/Expression",
                              quantity.expression);
      formulas.emplace_back(resolution_entry, study.resolution);
      formulas.emplace_back("Study/Time", study.time_result);
      return formulas;
    }
  } // namespace


  void
  check_formulas(const Study &study, const std::vector<PlannedRun> &runs)
  {
    for (const auto &[path, formula] : result_formulas(study))
      check_syntax(study, path, formula);
    for (const Quantity &quantity : study.quantities)
      check_truth(study, quantity, runs);
    check_claims(study, runs);
  }


  void
  check_results(const Study                   &study,
                const std::vector<PlannedRun> &runs,
                const std::vector<Record>     &records)
  {
    std::set<unsigned int> waiting, finished;
    std::set<std::string>  known;
    for (unsigned int r = 0; r < runs.size(); ++r)
      if (records[r].state == Record::State::finished)
        {
          finished.insert(runs[r].series);
          for (const auto &variable : variables_of(runs[r], records[r]))
            known.insert(variable.first);
        }
      else if (records[r].state == Record::State::not_run)
        waiting.insert(runs[r].series);
    for (const unsigned int series : waiting)
      if (finished.count(series) == 0)
        return;
    if (finished.empty())
      return;
    // Without errors nobody asks what they are drawn against.
    const bool has_truth = std::any_of(
        study.quantities.begin(),
        study.quantities.end(),
        [](const Quantity &quantity) { return quantity.truth != "none"; });
    for (const auto &[path, formula] : result_formulas(study))
      for (const std::string &name : names_in(formula))
        if (known.count(name) == 0 && (has_truth || path != resolution_entry))
          throw InputError(study.place_of(path) + " names '" + name +
                           "', which no run gives." +
                           did_you_mean(name, {known.begin(), known.end()}) +
                           " The names are those of the runs' summary.json.");
  }


  std::vector<Row>
  evaluate_runs(const Study                   &study,
                const std::vector<PlannedRun> &runs,
                const std::vector<Record>     &records)
  {
    std::vector<Row> rows;
    for (unsigned int r = 0; r < runs.size(); ++r)
      rows.push_back(row_of(study, runs[r], records[r]));
    set_errors(study, rows);
    return rows;
  }
} // namespace Morsel::Study
