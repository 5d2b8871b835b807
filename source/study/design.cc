#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/design.h>
#include <morsel/study/sensitivity.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <random>

namespace Morsel::Study
{
  namespace
  {
    /// Of a series: more are a slip of the pen, or take years.
    constexpr double most_runs = 10000.;


    /// Values From ... To of a linear, logarithmic or random axis.
    std::vector<double>
    range_values(const Axis &axis)
    {
      // Each axis has draws of its own, whatever its seed.
      std::mt19937_64     generator(axis.seed +
                                std::stoull(text_hash(axis.name), nullptr, 16));
      std::vector<double> values;
      for (unsigned int i = 0; i < axis.count; ++i)
        {
          // 53 random bits make a number in [0, 1), the same everywhere.
          const double t =
              axis.kind == "random"
                  ? static_cast<double>(generator() >> 11) * 0x1p-53
                  : (axis.count == 1 ? 0. : i / (axis.count - 1.));
          values.push_back(axis.kind == "logarithmic"
                               ? axis.from * std::pow(axis.to / axis.from, t)
                               : axis.from + (axis.to - axis.from) * t);
        }
      return values;
    }


    std::vector<std::string>
    listed_values(const Study &study, const Axis &axis, const std::string &path)
    {
      const std::vector<std::string> values = list_items(axis.values);
      if (values.empty())
        throw InputError(study.place_of(path + "Values") +
                         " is empty: list the values that the study shall "
                         "take, as in '7, 13, 25'.");
      for (const std::string &value : values)
        if (axis.kind == "numbers" && !number_in(value))
          throw InputError(study.place_of(path + "Values") + " has '" + value +
                           "' where a number belongs (for texts set 'Kind = "
                           "texts').");
      return values;
    }


    /// The axes of a series, in the order of the file.
    std::vector<const Axis *>
    axes_of(const Study &study, const Series &series)
    {
      const std::vector<std::string> names = list_items(series.axes);
      std::vector<const Axis *>      axes;
      for (const Axis &axis : study.axes)
        if (names.empty() ||
            std::find(names.begin(), names.end(), axis.name) != names.end())
          axes.push_back(&axis);
      return axes;
    }


    /// An axis with its values, and which factor of the product it follows.
    struct Factor
    {
      const Axis              *axis;
      std::vector<std::string> values;
      unsigned int             digit;
    };


    /// The factors of a series; sizes gets the lengths of the independent ones.
    std::vector<Factor>
    factors_of(const Study               &study,
               const Series              &series,
               std::vector<unsigned int> &sizes)
    {
      const std::vector<const Axis *>     axes = axes_of(study, series);
      std::map<std::string, unsigned int> digits;
      std::vector<Factor>                 factors;
      for (const bool leaders : {true, false})
        for (const Axis *axis : axes)
          {
            if (axis->partner.empty() != leaders)
              continue;
            Factor factor{axis, values_of(study, *axis), 0};
            if (leaders)
              {
                digits[axis->name] = sizes.size();
                sizes.push_back(factor.values.size());
              }
            const std::string &leader = leaders ? axis->name : axis->partner;
            const std::string  path   = "Axis " + axis->name + "/Together with";
            if (digits.count(leader) == 0)
              throw InputError(study.place_of(path) + " = '" + leader +
                               "' must name an axis of the same series that "
                               "goes together with no other one.");
            factor.digit = digits[leader];
            if (factor.values.size() != sizes[factor.digit])
              throw InputError(
                  study.place_of(path) + " = '" + leader + "': the axis has " +
                  std::to_string(factor.values.size()) +
                  " values and its "
                  "partner " +
                  std::to_string(sizes[factor.digit]) + "; give as many.");
            factors.push_back(factor);
          }
      return factors;
    }


    /// "Section/Key = text" as an override, formulas filled in; {series} is the
    /// name of the series.
    /// @param value what an entry without text gets, if there is one
    std::string
    override_of(const Study       &study,
                const std::string &path,
                const std::string &item,
                const PlannedRun  &run,
                const std::string *value)
    {
      const std::size_t equals = item.find('=');
      if (equals == std::string::npos && value == nullptr)
        throw InputError(study.place_of(path) + " has '" + item +
                         "' where 'Section/Key = text' is needed.");
      auto texts = run.texts;
      texts.emplace("series", study.series[run.series].name);
      try
        {
          const auto filled = [&](const std::string &text) {
            return fill_in(trimmed(text), run.numbers, texts);
          };
          return filled(item.substr(0, equals)) + "=" +
                 (equals == std::string::npos
                      ? *value
                      : filled(item.substr(equals + 1)));
        }
      catch (const InputError &error)
        {
          throw InputError(study.place_of(path) + ": " + error.what());
        }
    }


    std::vector<std::string>
    split_entries(const std::string &text)
    {
      // Entries hold commas: only semicolons separate. A doubled one stands for
      // one in an entry's text.
      std::vector<std::string> items;
      std::string              item;
      for (std::size_t i = 0; i <= text.size(); ++i)
        if (i < text.size() && text[i] != ';')
          item += text[i];
        else if (i + 1 < text.size() && text[i + 1] == ';')
          item += text[i++];
        else
          {
            if (!trimmed(item).empty())
              items.push_back(trimmed(item));
            item.clear();
          }
      return items;
    }


    void
    set_overrides(const Study               &study,
                  const std::vector<Factor> &factors,
                  PlannedRun                &run)
    {
      const Series &series = study.series[run.series];
      const auto    append = [&](const std::vector<std::string> &more) {
        run.overrides.insert(run.overrides.end(), more.begin(), more.end());
      };
      append(overrides_of(study,
                          "Series " + series.name + "/Entries",
                          series.entries,
                          run,
                          nullptr));
      for (const Factor &factor : factors)
        append(overrides_of(study,
                            "Axis " + factor.axis->name + "/Entries",
                            factor.axis->entries,
                            run,
                            &run.texts[factor.axis->name]));
    }


    void
    plan_series(const Study             &study,
                const unsigned int       number,
                std::vector<PlannedRun> &runs)
    {
      std::vector<unsigned int> sizes;
      const std::vector<Factor> factors =
          factors_of(study, study.series[number], sizes);
      double n_runs = 1.;
      for (const unsigned int size : sizes)
        n_runs *= size;
      if (n_runs > most_runs)
        throw InputError("Series '" + study.series[number].name +
                         "' would take " + number_text(n_runs) +
                         " runs; at most 10000 are allowed: give its axes "
                         "fewer values.");
      for (unsigned int i = 0; i < n_runs; ++i)
        {
          // The digits of i in the mixed base of the sizes, last one fastest.
          std::vector<unsigned int> digits(sizes.size());
          for (unsigned int d = sizes.size(), rest = i; d-- > 0;)
            {
              digits[d] = rest % sizes[d];
              rest /= sizes[d];
            }
          PlannedRun run;
          run.series = number;
          run.label  = study.series[number].name;
          for (const Factor &factor : factors)
            {
              const std::string &value = factor.values[digits[factor.digit]];
              run.texts[factor.axis->name] = value;
              if (factor.axis->kind != "texts")
                run.numbers[factor.axis->name] = *number_in(value);
              run.label += ", " + factor.axis->name + " = " + value;
            }
          set_overrides(study, factors, run);
          run.folder = folder_name(run);
          runs.push_back(run);
        }
    }


    /// An axis that reaches no entry is a mistake: its runs would be the same.
    void
    check_use(const Study &study)
    {
      std::string texts;
      for (const Series &series : study.series)
        texts += series.entries + ";";
      for (const Axis &axis : study.axes)
        texts += axis.entries + ";";
      std::set<std::string> used;
      for (std::size_t i = texts.find('{'); i != std::string::npos;
           i             = texts.find('{', i + 1))
        used.merge(names_in(texts.substr(i + 1, texts.find('}', i) - i - 1)));
      for (const Axis &axis : study.axes)
        if (axis.entries.empty() && used.count(axis.name) == 0)
          throw InputError(study.place_of("Axis " + axis.name + "/Entries") +
                           " is missing: say which entries of the scene the "
                           "axis varies, as in 'XFEM/Cells along x'.");
    }
  } // namespace


  std::vector<std::string>
  overrides_of(const Study       &study,
               const std::string &path,
               const std::string &entries,
               const PlannedRun  &run,
               const std::string *value)
  {
    std::vector<std::string> overrides;
    for (const std::string &item : split_entries(entries))
      overrides.push_back(override_of(study, path, item, run, value));
    return overrides;
  }


  std::string
  folder_name(const PlannedRun &run)
  {
    std::string name;
    for (const char c : run.label.substr(0, 60))
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' ||
          c == '-' || c == '=')
        name += c;
      else if (c == ',' || (c != ' ' && !name.empty() && name.back() != '_'))
        name += '_';
    std::string all = run.label;
    for (const std::string &text : run.overrides)
      all += "\n" + text;
    return name + "_" + text_hash(all).substr(0, 6);
  }


  bool
  has_value(const PlannedRun  &run,
            const std::string &axis,
            const std::string &value)
  {
    const auto number = run.numbers.find(axis);
    if (number == run.numbers.end())
      {
        const auto text = run.texts.find(axis);
        return text != run.texts.end() && text->second == value;
      }
    const auto wanted = number_in(value);
    return wanted && std::abs(*wanted - number->second) <=
                         1e-9 * std::max(1., std::abs(number->second));
  }


  std::map<std::string, std::string>
  setting_of(const Study &study, const PlannedRun &run)
  {
    std::map<std::string, std::string> setting;
    for (const auto &[axis, text] : run.texts)
      if (!study.find_axis(axis)->is_random())
        setting[axis] = text;
    return setting;
  }


  std::vector<std::string>
  values_of(const Study &study, const Axis &axis)
  {
    const std::string path = "Axis " + axis.name + "/";
    if (axis.kind == "numbers" || axis.kind == "texts")
      return listed_values(study, axis, path);
    if (axis.count == 0)
      throw InputError(study.place_of(path + "Count") +
                       " is missing or 0: say how many values the axis '" +
                       axis.name + "' has.");
    std::vector<std::string> values;
    if (axis.kind == "seeds")
      {
        for (unsigned int i = 0; i < axis.count; ++i)
          values.push_back(std::to_string(axis.seed + i));
        return values;
      }
    if (axis.kind == "logarithmic" && !(axis.from * axis.to > 0.))
      throw InputError(study.place_of(path + "From") + " = " +
                       number_text(axis.from) +
                       " and 'To' = " + number_text(axis.to) +
                       " must have the same sign and not be 0 on a "
                       "logarithmic axis.");
    for (const double value : range_values(axis))
      {
        const std::string text =
            value_text(axis.whole ? std::round(value) : value);
        if (!axis.whole ||
            std::find(values.begin(), values.end(), text) == values.end())
          values.push_back(text);
      }
    return values;
  }


  std::vector<PlannedRun>
  plan_runs(const Study &study)
  {
    check_use(study);
    std::vector<PlannedRun> runs;
    for (unsigned int s = 0; s < study.series.size(); ++s)
      plan_series(study, s, runs);
    append_variations(study, runs);
    return runs;
  }
} // namespace Morsel::Study
