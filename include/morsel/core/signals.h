#ifndef morsel_core_signals_h
#define morsel_core_signals_h

namespace Morsel
{
  /// From now on SIGINT and SIGTERM ask the program to end when it can; a
  /// second signal of the same kind ends the program at once. SIGUSR1 asks
  /// for a checkpoint.
  void
  catch_signals();


  /// From now on SIGINT and SIGTERM end the program at once, with a sentence
  /// and the status of an interruption; for work that has nothing to keep.
  void
  end_on_signals();


  /// Whether SIGINT or SIGTERM has arrived.
  bool
  interrupt_requested();


  /// Whether SIGUSR1 has arrived since the last call.
  bool
  take_checkpoint_request();
} // namespace Morsel

#endif
