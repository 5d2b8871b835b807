#ifndef morsel_fuzz_judge_h
#define morsel_fuzz_judge_h

#include "mutations.h"
#include "sandbox.h"

#include <string>

namespace Fuzz
{
  /// What a run did that the program promises not to do; empty if nothing.
  /// @param validated whether it was asked to check the scene only.
  std::string
  complaint(const Mutation &mutation, const Outcome &outcome, bool validated);
} // namespace Fuzz

#endif
