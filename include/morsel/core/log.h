#ifndef morsel_core_log_h
#define morsel_core_log_h

#include <morsel/core/state_archive_fwd.h>

#include <chrono>
#include <deque>
#include <fstream>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace Morsel
{
  /// What a run tells while it goes: text to run.log and, unless quiet, to
  /// the terminal; one live line of progress; the wall time of each part.
  class RunLog
  {
  public:
    /// Opens the log.
    /// @param file_name run.log, or empty for none or none as yet.
    /// @param quiet nothing goes to the terminal.
    /// @param active whether this rank writes at all (rank 0).
    /// @throw FileError if the file cannot be opened.
    RunLog(const std::string &file_name, bool quiet, bool active);

    /// Opens the file of a log that has none as yet, and writes to it what
    /// came before.
    /// @param append to what a run that goes on has logged.
    /// @throw FileError if the file cannot be opened.
    void
    open(const std::string &file_name, bool append = false);

    ~RunLog();

    RunLog(const RunLog &) = delete;
    RunLog &
    operator=(const RunLog &) = delete;

    template <typename T>
    RunLog &
    operator<<(const T &item);

    /// std::endl and std::flush.
    RunLog &
    operator<<(std::ostream &(*manipulator)(std::ostream &));

    /// One line of advice, marked as such.
    void
    warning(const std::string &text);

    /// Tells how far the run is; call it every step. On a terminal the line
    /// is renewed a few times a second, in the log there is one every ten
    /// percent.
    /// @param fraction share of the run that is done [1].
    /// @param time simulated time [s].
    /// @param step number of steps done.
    void
    progress(double fraction, double time, unsigned long long step);

    /// Removes the live line; progress starts anew.
    void
    end_progress();

    /// Measures wall time from its construction to its end; costs two reads
    /// of the clock (some 50 ns).
    class Section
    {
    public:
      Section(double &seconds)
          : seconds(seconds)
          , begin(std::chrono::steady_clock::now())
      {}

      ~Section()
      {
        seconds += std::chrono::duration<double>(
                       std::chrono::steady_clock::now() - begin)
                       .count();
      }

      Section(const Section &) = delete;
      Section &
      operator=(const Section &) = delete;

    private:
      double                               &seconds;
      std::chrono::steady_clock::time_point begin;
    };

    /// Adds the wall time until the end of the scope to a part:
    /// `const auto timer = log.section("contact");`. Sections may nest; a
    /// part's time then holds that of the parts within it.
    /// @param name a string literal.
    Section
    section(const char *name)
    {
      return Section(seconds_of(name));
    }

    /// Seconds of each part, in the order of first use.
    std::vector<std::pair<std::string, double>>
    wall_times() const;

    /// Seconds since the log was opened.
    double
    wall_time() const;

    /// What the time of a run that goes on began with: loading adds the
    /// times of before to those from now on.
    void
    exchange_state(StateArchive &state);

    /// From here on the run's loop counts, see loop_wall_time(); a run that
    /// is set up again in between goes on with the same loop.
    void
    begin_loop()
    {
      if (!loop_begin)
        loop_begin = wall_time();
    }

    /// Seconds since begin_loop().
    double
    loop_wall_time() const
    {
      return wall_time() - loop_begin.value_or(0.);
    }

    /// Writes the table of parts, with shares of the whole.
    void
    print_wall_times();

  private:
    struct Part
    {
      std::string name;
      const char *literal; ///< by which it was asked for last
      double      seconds;
    };

    double &
    seconds_of(const char *name);

    void
    write(const std::string &text);

    using Clock = std::chrono::steady_clock;

    std::ofstream         file;
    std::string           before_file; ///< what was logged before it was opened
    bool                  to_terminal;
    bool                  active;
    bool                  live_line_allowed;
    bool                  live_line_shown = false;
    Clock::time_point     begin;
    double                seconds_before = 0.; ///< of the run that goes on
    std::optional<double> loop_begin;          ///< [s]
    Clock::time_point     progress_begin;
    Clock::time_point     last_shown;
    int                   last_tenth = -1;
    /// When progress began; of a run that goes on not zero.
    double             first_fraction = -1.;
    unsigned long long first_step     = 0;
    /// A deque, since open sections point into it while it grows.
    std::deque<Part> parts;
  };


  template <typename T>
  RunLog &
  RunLog::operator<<(const T &item)
  {
    if (active)
      {
        std::ostringstream text;
        text << item;
        write(text.str());
      }
    return *this;
  }
} // namespace Morsel

#endif
