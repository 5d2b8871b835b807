#ifndef morsel_core_number_list_h
#define morsel_core_number_list_h

#include <morsel/core/errors.h>

#include <deal.II/base/utilities.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// "1, 2, 3" as numbers; nothing for an empty text.
  /// @throws InputError with a clause that says what is wrong, for the caller
  ///   to put the entry before.
  inline std::vector<double>
  number_list(const std::string &text, const unsigned int n)
  {
    std::vector<double> values;
    try
      {
        values = dealii::Utilities::string_to_double(
            dealii::Utilities::split_string_list(text, ','));
      }
    catch (const dealii::ExceptionBase &)
      {
        values.assign(n + 1, 0.);
      }
    if (!values.empty() && values.size() != n)
      throw InputError("it must be " + std::to_string(n) +
                       " numbers with commas between them.");
    return values;
  }
} // namespace Morsel

#endif
