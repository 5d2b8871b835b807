#ifndef morsel_fuzz_mutate_values_h
#define morsel_fuzz_mutate_values_h

#include "random.h"

#include <string>

namespace Fuzz
{
  /// Texts in place of a number or a choice: extreme, no numbers, other units,
  /// expressions, files that are none.
  const std::string &
  strange_value(Random &random);

  /// A value that resembles the given one: a number scaled, its sign turned,
  /// a list longer, shorter or in another order; or a strange one.
  std::string
  mutate_value(const std::string &value, Random &random);
} // namespace Fuzz

#endif
