#ifndef morsel_study_check_h
#define morsel_study_check_h

#include <morsel/study/study.h>

namespace Morsel::Study
{
  /// Checks all of a study that shows without its base scenes: names of axes,
  /// series and quantities, truths, claims, relations and figures.
  /// @throw InputError with the place of the mistake
  void
  check(const Study &study);
} // namespace Morsel::Study

#endif
