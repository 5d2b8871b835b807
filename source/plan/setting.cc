#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/plan/setting.h>
#include <morsel/study/analysis.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Plan
{
  namespace
  {
    const std::string body_mark = "{body}";


    std::string
    with_body(std::string entry, const std::string &body)
    {
      for (std::size_t i = entry.find(body_mark); i != std::string::npos;
           i             = entry.find(body_mark))
        entry.replace(i, body_mark.size(), body);
      return entry;
    }


    void
    add_overrides(std::vector<std::string> &overrides,
                  const Method             &method,
                  const std::string        &body,
                  const Study::Variables   &variables)
    {
      const auto add = [&](const std::string &entry, const std::string &value) {
        const std::string text = with_body(entry, body) + "=" + value;
        if (std::find(overrides.begin(), overrides.end(), text) ==
            overrides.end())
          overrides.push_back(text);
      };
      for (const auto &[entry, value] : method.entries)
        add(entry, value);
      for (const auto &[entry, formula] : method.formulas)
        try
          {
            add(entry,
                Study::value_text(Study::finite_value(formula, variables)));
          }
        catch (const InputError &error)
          {
            throw FileError("The recorded method '" + method.name + "', '" +
                            entry + "': " + error.what());
          }
    }
  } // namespace


  double
  read_accuracy(const std::string &text)
  {
    std::string number = trimmed(text);
    double      unit   = 1.;
    if (!number.empty() && number.back() == '%')
      {
        number = trimmed(number.substr(0, number.size() - 1));
        unit   = 0.01;
      }
    const std::optional<double> value = Study::number_in(number);
    if (!value || !(*value * unit > 0. && *value * unit < 1.))
      throw InputError("--plan: '" + text +
                       "' is no accuracy; give a relative error above 0 and "
                       "below 1, such as 1e-3 or 0.1%.");
    return *value * unit;
  }


  std::optional<double>
  size_to_reach(const Method &method, const double accuracy)
  {
    std::vector<double> sizes, errors;
    for (const RecordedRun &run : method.runs)
      {
        sizes.push_back(run.size);
        errors.push_back(run.error);
      }
    using Kind         = Study::CostToReach::Kind;
    const auto reached = Study::cost_to_reach(sizes, errors, accuracy);
    if (reached.kind == Kind::not_reached)
      return std::nullopt;
    double recorded = largest_run(method).size;
    for (const double size : sizes)
      if (size >= (1. - 1e-9) * reached.cost)
        recorded = std::min(recorded, size);
    const auto with_margin =
        Study::cost_to_reach(sizes, errors, accuracy / interpolation_margin);
    return with_margin.kind == Kind::not_reached
               ? recorded
               : std::min(recorded, with_margin.cost);
  }


  const RecordedRun &
  largest_run(const Method &method)
  {
    return *std::max_element(
        method.runs.begin(),
        method.runs.end(),
        [](const auto &a, const auto &b) { return a.size < b.size; });
  }


  std::vector<std::string>
  overrides_of(
      const Method                                                &method,
      const double                                                 size,
      const Study::Variables                                      &scene,
      const std::vector<std::pair<std::string, Study::Variables>> &bodies)
  {
    std::vector<std::string> overrides;
    Study::Variables         variables = scene;
    variables["size"]                  = size;
    if (bodies.empty())
      add_overrides(overrides, method, "", variables);
    for (const auto &[body, own] : bodies)
      {
        Study::Variables all = own;
        all.insert(variables.begin(), variables.end());
        add_overrides(overrides, method, body, all);
      }
    return overrides;
  }
} // namespace Morsel::Plan
