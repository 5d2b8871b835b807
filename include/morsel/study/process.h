#ifndef morsel_study_process_h
#define morsel_study_process_h

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace Morsel::Study
{
  /// How a process ended.
  struct Ended
  {
    int    status    = 0;  ///< exit status, or minus the signal that ended it
    double wall_time = 0.; ///< from start to end [s]
    double cpu_time  = 0.; ///< user and system [s]
    bool   too_long  = false; ///< it was ended at its time limit
  };


  /// A process of this program that runs beside this one. It ends with this
  /// one: the destructor, or the system, sees to it.
  class ChildProcess
  {
  public:
    /// Starts the program's own executable.
    /// @param arguments without the program's name
    /// @param output file that gets its standard output and error
    /// @param time_limit [s]; 0: none
    /// @throw FileError if it cannot be started
    ChildProcess(const std::vector<std::string> &arguments,
                 const std::string              &output,
                 double                          time_limit);

    /// Ends the process if it still runs.
    ~ChildProcess();

    ChildProcess(const ChildProcess &) = delete;
    ChildProcess &
    operator=(const ChildProcess &) = delete;

    /// How it ended, or nothing while it runs. Ends it by SIGKILL once its time
    /// is over.
    std::optional<Ended>
    poll();

  private:
    using Clock = std::chrono::steady_clock;

    double
    age() const;

    pid_t                pid = -1;
    double               time_limit;
    bool                 too_long = false;
    Clock::time_point    begin;
    std::optional<Ended> ended;
  };
} // namespace Morsel::Study

#endif
