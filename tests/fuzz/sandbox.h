#ifndef morsel_fuzz_sandbox_h
#define morsel_fuzz_sandbox_h

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace Fuzz
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  // They reserve terabytes of addresses and take a few times as long.
  constexpr double limit_of_time = 300., limit_of_memory = 0.;
#else
  constexpr double limit_of_time = 60., limit_of_memory = 4e9;
#endif


  struct Limits
  {
    double processor_time = limit_of_time;   ///< [s]
    double wall_time      = 900.;            ///< [s]: the machine may be busy
    double memory         = limit_of_memory; ///< addresses [B]; 0: no limit
    /// Processor time until SIGTERM is sent [s]; 0: never.
    double patience = 0.;
  };


  /// How a run ended.
  struct Outcome
  {
    int                      status         = 0; ///< exit status, if no signal
    int                      signal         = 0; ///< that ended it; 0: none
    bool                     interrupted    = false; ///< SIGTERM was sent
    bool                     killed         = false; ///< it took too long
    double                   processor_time = 0.;    ///< [s]
    double                   memory         = 0.;    ///< resident, largest [B]
    std::string              output, errors;         ///< what it wrote
    std::string              run_errors; ///< what runs of a study wrote
    std::vector<std::string> changes;    ///< files written, changed, removed
  };


  /// A copy of the gallery in a folder of its own, in which one run at a time
  /// is started. The folder of the copy is two folders below the sandbox, so
  /// that what is written beside it shows.
  class Sandbox
  {
  public:
    /// @param folder is made; the copy is in folder/a/b.
    Sandbox(const std::string              &folder,
            const std::string              &root,
            const std::vector<std::string> &files);

    ~Sandbox();

    Sandbox(const Sandbox &) = delete;
    Sandbox &
    operator=(const Sandbox &) = delete;

    /// Puts a text in place of a file of the gallery.
    void
    put(const std::string &file, const std::string &text);

    /// Starts a function in a process of its own with the copy as its folder;
    /// it returns the exit status.
    void
    start(const std::function<int()> &program, const Limits &limits);

    bool
    is_free() const
    {
      return child == 0;
    }

    /// How the run ended, once it has; the copy is then as it was before
    /// put(), and everything else removed.
    std::optional<Outcome>
    poll();

  private:
    /// Size and time of change of each file, as text.
    using Snapshot = std::map<std::string, std::string>;

    Snapshot
    snapshot() const;

    void
    restore(Outcome &outcome);

    std::string folder, tree, root;
    Snapshot    before;
    std::string replaced_file;
    double      interrupted_at = 0.; ///< wall time [s]
    pid_t       child          = 0;
    Limits      limits;
    bool        was_interrupted = false, was_killed = false;
    std::chrono::steady_clock::time_point begin;
  };
} // namespace Fuzz

#endif
