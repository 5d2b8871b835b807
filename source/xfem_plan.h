#ifndef morsel_xfem_plan_h
#define morsel_xfem_plan_h

#include <morsel/fe/plate_problem.h>
#include <morsel/output/summary.h>
#include <morsel/prediction.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// Which effects a plate's extended finite elements have on, and who asked
  /// for each.
  std::vector<Output::Effect>
  effects_of(const FE::PlateParameters          &plate,
             const std::vector<Fracture::Crack> &cracks);


  /// Refuses a plate whose solution would not fit into this machine.
  /// @throws InputError naming entries, unknowns and memory
  void
  check_memory(const FE::PlateParameters &plate);


  /// What a run would be.
  /// @throws InputError for a mistake that only the mesh shows
  Prediction
  predict_xfem(const FE::PlateParameters          &plate,
               const std::vector<Fracture::Crack> &cracks);
} // namespace Morsel

#endif
