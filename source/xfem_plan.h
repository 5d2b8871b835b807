#ifndef morsel_xfem_plan_h
#define morsel_xfem_plan_h

#include <morsel/fe/plate_problem.h>
#include <morsel/output/summary.h>

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


  /// What a run would do: effects, cells, unknowns, predicted memory and time.
  /// @throws InputError for a mistake that only the mesh shows
  std::string
  describe_xfem_run(const FE::PlateParameters          &plate,
                    const std::vector<Fracture::Crack> &cracks);
} // namespace Morsel

#endif
