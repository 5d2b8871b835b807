#ifndef morsel_core_machine_h
#define morsel_core_machine_h

namespace Morsel
{
  /// Memory of this machine [B].
  double
  machine_memory();
} // namespace Morsel

#endif
