#include <morsel/core/parameters.h>
#include <morsel/core/suggestions.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace Morsel
{
  using dealii::ParameterHandler;

  namespace
  {
    /// Bars would end a cell of a Markdown table.
    std::string
    as_cell(std::string text)
    {
      for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos;
           i += 2)
        text.replace(i, 1, "\\|");
      return text;
    }
  } // namespace


  std::string
  parameters_as_prm(const ParameterHandler &prm, const bool documented)
  {
    std::ostringstream text;
    prm.print_parameters(
        text,
        ParameterHandler::KeepDeclarationOrder |
            (documented ? ParameterHandler::PRM : ParameterHandler::ShortPRM));
    return text.str();
  }


  std::string
  parameters_as_json(const ParameterHandler &prm)
  {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeclaredParameter &p : declared_parameters(prm))
      list.push_back({{"section", p.section},
                      {"entry", p.key},
                      {"default", p.default_value},
                      {"value", p.value},
                      {"unit", unit_of(p.documentation)},
                      {"allowed", allowed_values(p.pattern)},
                      {"meaning", p.documentation}});
    return list.dump(2) + "\n";
  }


  std::string
  parameters_as_markdown(const ParameterHandler &prm)
  {
    std::string text, section = "-";
    for (const DeclaredParameter &p : declared_parameters(prm))
      {
        if (p.section != section)
          {
            section = p.section;
            text += "\n## " + (section.empty() ? "Top level" : section) +
                    "\n\n| entry | default | allowed | meaning [unit] "
                    "|\n|-|-|-|-|\n";
          }
        text += "| " + p.key + " | " +
                (p.default_value.empty() ? "" : "`" + p.default_value + "`") +
                " | " + as_cell(allowed_values(p.pattern)) + " | " +
                as_cell(p.documentation) + " |\n";
      }
    return text;
  }
} // namespace Morsel
