#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/check.h>
#include <morsel/study/formula.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace Morsel::Study
{
  namespace
  {
    bool
    is_identifier(const std::string &text)
    {
      return !text.empty() &&
             std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
             std::all_of(text.begin(), text.end(), [](const unsigned char c) {
               return std::isalnum(c) != 0 || c == '_';
             });
    }


    void
    check_names(const Study &study)
    {
      const auto check = [&](const std::string &kind, const std::string &name) {
        if (!is_identifier(name))
          throw InputError(study.file + ": The name in the section '" + kind +
                           " " + name +
                           "' is not allowed: give letters, digits and "
                           "underscores, since formulas may use it.");
      };
      for (const Axis &axis : study.axes)
        check("Axis", axis.name);
      for (const Quantity &quantity : study.quantities)
        check("Quantity", quantity.name);
    }


    void
    check_axis_name(const Study       &study,
                    const std::string &name,
                    const std::string &path)
    {
      std::vector<std::string> known;
      for (const Axis &axis : study.axes)
        known.push_back(axis.name);
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError(study.place_of(path) + " names the axis '" + name +
                         "', which has no section 'Axis " + name + "'." +
                         did_you_mean(name, known));
    }


    void
    check_truth(const Study &study, const Quantity &quantity)
    {
      const std::string section = "Quantity " + quantity.name + "/";
      const auto        need = [&](const char *key, const std::string &value) {
        if (value.empty())
          throw InputError(study.place_of(section + "Truth") + " = '" +
                           quantity.truth + "' needs '" + key +
                           "', which is missing.");
      };
      if (quantity.truth == "formula")
        need("Truth formula", quantity.truth_formula);
      if (quantity.truth == "table")
        {
          need("Truth axis", quantity.truth_axis);
          need("Truth table", quantity.truth_table);
        }
      if (quantity.truth == "none" &&
          !(quantity.truth_formula.empty() && quantity.truth_table.empty()))
        throw InputError(study.place_of(section + "Truth") +
                         " = 'none', but a truth is given beside it: set "
                         "'Truth' to 'formula' or 'table'.");
      for (const std::string &name : list_items(quantity.truth_axis))
        if (name != "series")
          check_axis_name(study, name, section + "Truth axis");
    }


    /// Names what a list of the study has, or says what it lacks.
    template <typename Part>
    void
    check_part_name(const Study             &study,
                    const std::vector<Part> &parts,
                    const std::string       &kind,
                    const std::string       &name,
                    const std::string       &path)
    {
      std::vector<std::string> known;
      for (const Part &part : parts)
        known.push_back(part.name);
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError(study.place_of(path) + " = '" + name +
                         "': the study has no " + kind + " of this name." +
                         did_you_mean(name, known));
    }


    void
    check_number(const Study       &study,
                 const std::string &path,
                 const std::string &text)
    {
      if (!text.empty() && !number_in(text))
        throw InputError(study.place_of(path) + " = '" + text +
                         "' is no number; give one, or leave it empty.");
    }


    void
    check_series_names(const Study       &study,
                       const std::string &path,
                       const std::string &names)
    {
      for (const std::string &name : list_items(names))
        check_part_name(study, study.series, "series", name, path);
    }


    void
    check_relation(const Study &study, const Relation &relation)
    {
      const std::string section = "Relation " + relation.name + "/";
      for (const auto &[key, name] :
           {std::make_pair("x", relation.x), std::make_pair("y", relation.y)})
        check_part_name(
            study, study.quantities, "quantity", name, section + key);
      const std::string path = section + "Expected correlation";
      check_number(study, path, relation.expected_correlation);
      if (const auto r = number_in(relation.expected_correlation);
          r && !(std::abs(*r) < 1.))
        throw InputError(study.place_of(path) + " = " +
                         relation.expected_correlation +
                         " must lie between -1 and 1.");
    }


    void
    check_claim(const Study &study, const Claim &claim)
    {
      const std::string section = "Claim " + claim.name + "/";
      check_number(study, section + "Value", claim.value);
      check_series_names(study, section + "Series", claim.series);
      axis_values(study, section + "At", claim.at);
      if (!claim.quantity.empty())
        check_part_name(study,
                        study.quantities,
                        "quantity",
                        claim.quantity,
                        section + "Quantity");
      if (!claim.relation.empty())
        check_part_name(study,
                        study.relations,
                        "relation",
                        claim.relation,
                        section + "Relation");
      if (!claim.quantity.empty() && !claim.relation.empty())
        throw InputError(study.place_of(section + "Relation") +
                         ": a claim is about a quantity or about a relation; "
                         "leave one of them out.");
      const bool has_number = !(claim.quantity + claim.relation).empty();
      if (has_number && claim.series.empty() && study.series.size() > 1)
        throw InputError(study.place_of(section + "Series") +
                         " is missing: say which of the " +
                         std::to_string(study.series.size()) +
                         " series is compared with what is stated.");
    }


    void
    check_figure(const Study &study, const Figure &figure)
    {
      const std::string section = "Figure " + figure.name + "/";
      const auto        need = [&](const char *key, const std::string &text) {
        if (text.empty())
          throw InputError(study.place_of(section + key) +
                           " is missing: a figure of kind '" + figure.kind +
                           "' needs it.");
      };
      if (figure.kind == "history")
        {
          need("x", figure.x);
          need("y", figure.y);
        }
      else
        need("Picture", figure.picture);
      check_series_names(study, section + "Series", figure.series);
      axis_values(study, section + "Where", figure.where);
    }


    void
    check_sensitivity(const Study &study, const Sensitivity &sensitivity)
    {
      const std::string section = "Sensitivity " + sensitivity.name + "/";
      if (sensitivity.entries.empty())
        throw InputError(study.place_of(section + "Entries") +
                         " is missing: say which entry of the scene is varied, "
                         "as in 'Body food/Solid/CFL factor'.");
      if (sensitivity.low == sensitivity.high)
        throw InputError(study.place_of(section + "High") + " = " +
                         number_text(sensitivity.high) +
                         " is also 'Low': give two different values.");
      check_number(study, section + "Base", sensitivity.base);
      check_series_names(study, section + "Series", sensitivity.series);
    }
  } // namespace


  std::vector<AxisValue>
  axis_values(const Study       &study,
              const std::string &path,
              const std::string &text)
  {
    std::vector<AxisValue> values;
    for (const std::string &item : list_items(text))
      {
        const std::size_t equals = item.find('=');
        if (equals == std::string::npos)
          throw InputError(study.place_of(path) + " has '" + item +
                           "' where 'axis = value' is needed.");
        values.push_back({trimmed(item.substr(0, equals)),
                          trimmed(item.substr(equals + 1))});
        check_axis_name(study, values.back().axis, path);
      }
    return values;
  }


  void
  check(const Study &study)
  {
    check_names(study);
    if (study.quantities.empty())
      throw InputError(study.file +
                       ": The study records nothing; name results of "
                       "summary.json in 'Study/Quantities'.");
    for (const Axis &axis : study.axes)
      if (!axis.partner.empty())
        check_axis_name(
            study, axis.partner, "Axis " + axis.name + "/Together with");
    for (const Series &series : study.series)
      for (const std::string &name : list_items(series.axes))
        check_axis_name(study, name, "Series " + series.name + "/Axes");
    for (const Quantity &quantity : study.quantities)
      check_truth(study, quantity);
    for (const Relation &relation : study.relations)
      check_relation(study, relation);
    for (const Claim &claim : study.claims)
      check_claim(study, claim);
    for (const Figure &figure : study.figures)
      check_figure(study, figure);
    for (const Sensitivity &sensitivity : study.sensitivities)
      check_sensitivity(study, sensitivity);
  }
} // namespace Morsel::Study
