#include <morsel/core/signals.h>

#include <morsel/core/errors.h>

#include <csignal>
#include <unistd.h>

namespace Morsel
{
  namespace
  {
    volatile std::sig_atomic_t signal_arrived    = 0;
    volatile std::sig_atomic_t checkpoint_wanted = 0;

    extern "C" void
    note_signal(int)
    {
      signal_arrived = 1;
    }

    extern "C" void
    end_at_once(int)
    {
      constexpr char text[] = "morsel: Interrupted before the scene was "
                              "solved; start it anew.\n";
      // Whether somebody reads it does not matter any more.
      [[maybe_unused]] const auto ignored =
          write(STDERR_FILENO, text, sizeof(text) - 1);
      _exit(static_cast<int>(ExitStatus::interrupted));
    }

    extern "C" void
    note_checkpoint(int)
    {
      checkpoint_wanted = 1;
    }
  } // namespace


  void
  catch_signals()
  {
    struct sigaction action = {};
    action.sa_handler       = note_signal;
    // SA_RESETHAND gives the second signal its usual, deadly effect.
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_handler = note_checkpoint;
    action.sa_flags   = SA_RESTART;
    sigaction(SIGUSR1, &action, nullptr);
  }


  void
  end_on_signals()
  {
    struct sigaction action = {};
    action.sa_handler       = end_at_once;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }


  bool
  interrupt_requested()
  {
    return signal_arrived != 0;
  }


  bool
  take_checkpoint_request()
  {
    const bool wanted = checkpoint_wanted != 0;
    checkpoint_wanted = 0;
    return wanted;
  }
} // namespace Morsel
