#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/formula.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace Morsel::Study
{
  namespace
  {
    /// deal.II prints what its parser dislikes before it throws; users get one
    /// sentence instead.
    class SilentErrors
    {
    public:
      SilentErrors()
          : buffer(std::cerr.rdbuf(nullptr))
      {}

      ~SilentErrors()
      {
        std::cerr.rdbuf(buffer);
        std::cerr.clear();
      }

    private:
      std::streambuf *buffer;
    };
  } // namespace


  namespace
  {
    /// muparser's.
    constexpr unsigned int longest_name = 100;
  } // namespace


  double
  evaluate(const std::string &formula, const Variables &variables)
  {
    std::vector<std::string> known;
    for (const auto &variable : variables)
      known.push_back(variable.first);
    for (const std::string &name : names_in(formula))
      if (name.size() > longest_name)
        throw InputError("the formula '" + formula + "' holds a name of " +
                         std::to_string(name.size()) + " letters; " +
                         std::to_string(longest_name) + " are allowed.");
      else if (variables.count(name) == 0)
        throw InputError("the formula '" + formula + "' names '" + name +
                         "', which is not known here." +
                         did_you_mean(name, known));

    Variables constants = variables;
    constants["pi"]     = dealii::numbers::PI;
    double value        = 0.;
    try
      {
        const SilentErrors silence;
        // One coordinate that no formula names: all variables are constants.
        dealii::FunctionParser<1> parser;
        parser.initialize("coordinate_without_use_", formula, constants);
        value = parser.value(dealii::Point<1>());
      }
    catch (const dealii::ExceptionBase &)
      {
        throw InputError("the formula '" + formula + "' is not understood.");
      }
    return value;
  }


  double
  finite_value(const std::string &formula, const Variables &variables)
  {
    const double value = evaluate(formula, variables);
    if (!std::isfinite(value))
      throw InputError("the formula '" + formula +
                       "' gives no finite number here.");
    return value;
  }


  std::set<std::string>
  names_in(const std::string &formula)
  {
    std::set<std::string> names;
    const auto            is_letter = [](const char c) {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    for (std::size_t i = 0; i < formula.size();)
      {
        std::size_t end = i + 1;
        if (is_letter(formula[i]))
          {
            while (end < formula.size() &&
                   (is_letter(formula[end]) ||
                    std::isdigit(static_cast<unsigned char>(formula[end]))))
              ++end;
            const std::size_t next = formula.find_first_not_of(" \t", end);
            const std::string name = formula.substr(i, end - i);
            const bool        is_function =
                next != std::string::npos && formula[next] == '(';
            if (!is_function && name != "pi")
              names.insert(name);
          }
        else if (std::isdigit(static_cast<unsigned char>(formula[i])) != 0)
          {
            // A number takes the e of its exponent with it.
            const char *const begin = formula.c_str() + i;
            char             *after = nullptr;
            std::strtod(begin, &after);
            end = i + static_cast<std::size_t>(after - begin);
          }
        i = end;
      }
    return names;
  }


  std::optional<double>
  number_in(const std::string &text)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      return std::nullopt;
    return value;
  }


  std::string
  value_text(const double value)
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%.14g", value);
    return text;
  }


  std::string
  fill_in(const std::string                        &text,
          const Variables                          &variables,
          const std::map<std::string, std::string> &texts)
  {
    std::string result;
    for (std::size_t i = 0; i < text.size();)
      {
        const std::size_t open = text.find('{', i);
        result += text.substr(i, open - i);
        if (open == std::string::npos)
          break;
        const std::size_t close = text.find('}', open);
        if (close == std::string::npos)
          throw InputError("the text '" + text +
                           "' opens a brace that it does "
                           "not close.");
        const std::string formula =
            trimmed(text.substr(open + 1, close - open - 1));
        const auto plain = texts.find(formula);
        result += plain != texts.end()
                      ? plain->second
                      : value_text(finite_value(formula, variables));
        i = close + 1;
      }
    return result;
  }
} // namespace Morsel::Study
