#ifndef morsel_study_formula_h
#define morsel_study_formula_h

#include <map>
#include <optional>
#include <set>
#include <string>

namespace Morsel::Study
{
  /// The values that formulas may use, by name.
  using Variables = std::map<std::string, double>;

  /// The value of a formula in muParser's syntax (sin, sqrt, ^, rint, if(), ...
  /// and pi); it need not be finite.
  /// @throw InputError, a sentence without place, if it is not understood or
  ///   names something unknown.
  double
  evaluate(const std::string &formula, const Variables &variables);


  /// The same, where only a finite number will do.
  /// @throw InputError also if it is not finite
  double
  finite_value(const std::string &formula, const Variables &variables);


  /// The names of the variables in a formula, pi excepted.
  std::set<std::string>
  names_in(const std::string &formula);


  /// The number that the whole text is, if it is one.
  std::optional<double>
  number_in(const std::string &text);


  /// A number as text with up to 14 digits: 0.3 stays 0.3 whatever sum made it.
  std::string
  value_text(double value);


  /// The text with every {formula} replaced by its value; a formula that is
  /// the name of a text is replaced by that text.
  /// @throw InputError, a sentence without place
  std::string
  fill_in(const std::string                        &text,
          const Variables                          &variables,
          const std::map<std::string, std::string> &texts);
} // namespace Morsel::Study

#endif
