#include <morsel/core/errors.h>
#include <morsel/core/parameters.h>
#include <morsel/core/suggestions.h>

#include <deal.II/base/patterns.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <sstream>

namespace Morsel
{
  using dealii::ParameterHandler;

  namespace
  {
    std::string
    joined_path(const std::string &section, const std::string &key)
    {
      return section.empty() ? key : section + "/" + key;
    }


    std::vector<std::string>
    split_path(const std::string &path)
    {
      std::vector<std::string> parts;
      std::istringstream       stream(path);
      for (std::string part; std::getline(stream, part, '/');)
        parts.push_back(part);
      return parts;
    }


    /// Walks deal.II's JSON description of the declared parameters; a
    /// parameter is a node with a text named "value".
    void
    collect_parameters(const nlohmann::ordered_json   &node,
                       const std::string              &section,
                       std::vector<DeclaredParameter> &result)
    {
      for (const auto &[name, child] : node.items())
        if (child.is_object() && child.contains("value") &&
            child["value"].is_string())
          result.push_back({section,
                            name,
                            child["default_value"],
                            child["value"],
                            child["documentation"],
                            child["pattern_description"]});
        else if (child.is_object())
          collect_parameters(child, joined_path(section, name), result);
    }


    /// What is wrong with an entry that is not declared: the section, or the
    /// key; with the nearest of what there is.
    std::string
    explain_unknown(const ParameterEntry                 &entry,
                    const std::vector<DeclaredParameter> &declared)
    {
      std::set<std::string>    sections;
      std::vector<std::string> keys_here;
      std::string              elsewhere;
      for (const DeclaredParameter &parameter : declared)
        {
          const std::vector<std::string> parts = split_path(parameter.section);
          std::string                    section;
          for (const std::string &part : parts)
            sections.insert(section = joined_path(section, part));
          if (parameter.section == entry.section)
            keys_here.push_back(parameter.key);
          else if (parameter.key == entry.key && elsewhere.empty())
            elsewhere = parameter.section;
        }

      std::string text = entry.where + ": ";
      if (!entry.section.empty() && sections.count(entry.section) == 0)
        {
          text += "There is no section '" + entry.section + "'.";
          const std::string suggestion =
              did_you_mean(entry.section, {sections.begin(), sections.end()});
          if (!suggestion.empty())
            return text + suggestion;
          if (entry.section.rfind("Body ", 0) == 0)
            return text + " A body's section 'Body <name>' needs its name in "
                          "the list 'Bodies', and the sections that fit its "
                          "'Kind'.";
          return text;
        }

      text += "There is no entry '" + entry.key + "' " +
              (entry.section.empty() ? std::string("at the top level")
                                     : "in section '" + entry.section + "'") +
              ".";
      const std::string suggestion = did_you_mean(entry.key, keys_here);
      if (!suggestion.empty())
        return text + suggestion;
      if (!elsewhere.empty())
        return text + " One of this name stands in section '" + elsewhere +
               "'.";
      return keys_here.empty()
                 ? text
                 : text + " Known there: " + quoted_list(keys_here) + ".";
    }


    /// The names of a selection pattern "[Selection a|b|c ]".
    std::vector<std::string>
    selection_of(const std::string &pattern)
    {
      const std::string start = "[Selection ";
      if (pattern.rfind(start, 0) != 0)
        return {};
      std::vector<std::string> names;
      std::istringstream       stream(
          pattern.substr(start.size(), pattern.rfind(']') - start.size()));
      for (std::string name; std::getline(stream, name, '|');)
        names.push_back(trimmed(name));
      return names;
    }


    /// Why a value was refused.
    std::string
    explain_value(const ParameterEntry    &entry,
                  const DeclaredParameter &parameter)
    {
      std::string text = entry.where + ": '" + entry.path() + "' = '" +
                         entry.value + "' is not allowed: give " +
                         allowed_values(parameter.pattern);
      const std::string unit = unit_of(parameter.documentation);
      const bool        numeric =
          selection_of(parameter.pattern).empty() &&
          parameter.pattern.find("[Bool]") == std::string::npos;
      if (numeric && !unit.empty())
        text += unit == "1" ? " (without unit)" : " in " + unit;
      text += ".";

      text += did_you_mean(entry.value, selection_of(parameter.pattern));
      const bool digits =
          entry.value.find_first_of("0123456789") != std::string::npos;
      const bool letters =
          entry.value.find_first_of("ghklmnPsuJNGM%") != std::string::npos;
      if (numeric && digits && letters)
        text += " Write the number alone, without a unit.";
      return text;
    }


    /// Why an entry was refused.
    std::string
    explain_refusal(const ParameterEntry &entry, const ParameterHandler &prm)
    {
      const std::vector<DeclaredParameter> declared = declared_parameters(prm);
      const auto                           parameter =
          std::find_if(declared.begin(), declared.end(), [&](const auto &p) {
            return p.path() == entry.path();
          });
      return parameter == declared.end() ? explain_unknown(entry, declared)
                                         : explain_value(entry, *parameter);
    }


    /// Sets an entry; returns whether it is declared and its value allowed.
    bool
    accepts(ParameterHandler &prm, const ParameterEntry &entry)
    {
      const std::vector<std::string> sections = split_path(entry.section);
      // To enter one that is not declared would make it.
      if (!prm.subsection_path_exists(sections))
        return false;
      for (const std::string &section : sections)
        prm.enter_subsection(section);
      bool accepted = true;
      try
        {
          prm.set(entry.key, entry.value);
        }
      catch (const dealii::ExceptionBase &)
        {
          accepted = false;
        }
      for (std::size_t i = 0; i < sections.size(); ++i)
        prm.leave_subsection();
      return accepted;
    }


    /// "from 0 to 1", "of at least 0" and so on for "0...1 (inclusive)".
    std::string
    range_in_words(const std::string &range)
    {
      const std::size_t dots  = range.find("...");
      const std::size_t blank = range.find(' ', dots);
      if (dots == std::string::npos)
        return "";
      const std::string lower    = range.substr(0, dots);
      const std::string upper    = range.substr(dots + 3, blank - dots - 3);
      const bool        no_lower = lower.find("MIN") != std::string::npos ||
                            lower.find("-MAX") != std::string::npos;
      const bool no_upper = upper.find("MAX") != std::string::npos;
      if (no_lower && no_upper)
        return "";
      if (no_upper)
        return " of at least " + lower;
      if (no_lower)
        return " of at most " + upper;
      return " from " + lower + " to " + upper;
    }
  } // namespace


  std::string
  ParameterEntry::path() const
  {
    return joined_path(section, key);
  }


  std::string
  DeclaredParameter::path() const
  {
    return joined_path(section, key);
  }


  std::string
  last_value(const std::vector<ParameterEntry> &entries,
             const std::string                 &path,
             const std::string                 &default_value)
  {
    const auto entry =
        std::find_if(entries.rbegin(), entries.rend(), [&](const auto &e) {
          return e.path() == path;
        });
    return entry == entries.rend() ? default_value : entry->value;
  }


  std::string
  last_place(const std::vector<ParameterEntry> &entries,
             const std::string                 &path)
  {
    const auto entry =
        std::find_if(entries.rbegin(), entries.rend(), [&](const auto &e) {
          return e.path() == path;
        });
    return entry == entries.rend() ? "" : entry->where;
  }


  std::vector<DeclaredParameter>
  declared_parameters(const ParameterHandler &prm)
  {
    std::ostringstream description;
    prm.print_parameters(description,
                         ParameterHandler::JSON |
                             ParameterHandler::KeepDeclarationOrder);
    std::vector<DeclaredParameter> result;
    collect_parameters(
        nlohmann::ordered_json::parse(description.str()), "", result);
    // The top level's own entries come first, as in every section.
    std::stable_partition(result.begin(), result.end(), [](const auto &p) {
      return p.section.empty();
    });
    return result;
  }


  void
  set_parameters(ParameterHandler                  &prm,
                 const std::vector<ParameterEntry> &entries)
  {
    for (const ParameterEntry &entry : entries)
      if (!accepts(prm, entry))
        throw InputError(explain_refusal(entry, prm));
  }


  std::string
  allowed_values(const std::string &pattern)
  {
    const auto starts_with = [&](const std::string &start) {
      return pattern.rfind(start, 0) == 0;
    };

    if (starts_with("[Bool"))
      return "'true' or 'false'";
    if (starts_with("[Selection"))
      return "one of " + quoted_list(selection_of(pattern));
    if (starts_with("[Double"))
      {
        const std::size_t begin = pattern.find(' ');
        return "a number" + (begin == std::string::npos
                                 ? ""
                                 : range_in_words(pattern.substr(begin + 1)));
      }
    if (starts_with("[Integer"))
      {
        const std::size_t begin = pattern.find("range ");
        return "a whole number" +
               (begin == std::string::npos
                    ? ""
                    : range_in_words(pattern.substr(begin + 6)));
      }
    if (starts_with("[List of <[Double"))
      {
        const std::size_t length = pattern.find("of length ");
        const std::size_t dots   = pattern.find("...", length);
        const std::string count =
            length == std::string::npos || dots == std::string::npos
                ? "0"
                : pattern.substr(length + 10, dots - length - 10);
        return (count == "0" ? "" : count + " ") +
               "numbers separated by commas";
      }
    if (starts_with("[List"))
      return "a list separated by commas";
    return "a text";
  }


  std::string
  unit_of(const std::string &documentation)
  {
    const std::size_t begin = documentation.find('[');
    const std::size_t end   = documentation.find(']', begin);
    return end == std::string::npos
               ? ""
               : documentation.substr(begin + 1, end - begin - 1);
  }


  std::string
  text_hash(const std::string &text)
  {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text)
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    std::ostringstream digits;
    digits << std::hex;
    digits.width(16);
    digits.fill('0');
    digits << hash;
    return digits.str();
  }
} // namespace Morsel
