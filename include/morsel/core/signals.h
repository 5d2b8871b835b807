#ifndef morsel_core_signals_h
#define morsel_core_signals_h

namespace Morsel
{
  /// From now on SIGINT and SIGTERM set a flag that the time loop polls; a
  /// second signal of the same kind ends the program at once.
  void
  catch_signals();

  /// Whether SIGINT or SIGTERM has arrived on this rank. Cheap: call it every
  /// step.
  bool
  interrupt_requested();
} // namespace Morsel

#endif
