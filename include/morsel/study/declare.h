#ifndef morsel_study_declare_h
#define morsel_study_declare_h

#include <morsel/study/study.h>

#include <deal.II/base/parameter_handler.h>

namespace Morsel::Study
{
  /// Binds everything that a study says to entries; its axes, series and
  /// quantities are there with their names, and the study must stay where it
  /// is meanwhile.
  void
  declare(Study &study, dealii::ParameterHandler &prm);
} // namespace Morsel::Study

#endif
