#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/state_archive.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <unistd.h>

namespace Morsel
{
  namespace
  {
    double
    seconds_between(const std::chrono::steady_clock::time_point begin,
                    const std::chrono::steady_clock::time_point end)
    {
      return std::chrono::duration<double>(end - begin).count();
    }


    template <typename... Values>
    std::string
    formatted(const char *format, const Values... values)
    {
      char text[256];
      std::snprintf(text, sizeof(text), format, values...);
      return text;
    }


    /// "4.2 s", "3:05 min" or "2:10 h".
    std::string
    duration_text(const double seconds)
    {
      if (!(seconds < 1e7))
        return "long";
      if (seconds < 60.)
        return formatted("%.1f s", seconds);
      const long whole = std::lround(seconds);
      if (whole < 3600)
        return formatted("%ld:%02ld min", whole / 60, whole % 60);
      return formatted("%ld:%02ld h", whole / 3600, whole / 60 % 60);
    }
  } // namespace


  RunLog::RunLog(const std::string &file_name,
                 const bool         quiet,
                 const bool         active)
      : to_terminal(active && !quiet)
      , active(active)
      , live_line_allowed(to_terminal && isatty(STDOUT_FILENO) != 0)
      , begin(Clock::now())
      , progress_begin(begin)
      , last_shown(begin)
  {
    if (!file_name.empty())
      open(file_name);
  }


  void
  RunLog::open(const std::string &file_name, const bool append)
  {
    if (!active)
      return;
    file.open(file_name, append ? std::ios::app : std::ios::trunc);
    if (!file)
      throw FileError("The log '" + file_name +
                      "' cannot be opened for writing.");
    file << before_file << std::flush;
    before_file.clear();
  }


  RunLog::~RunLog()
  {
    end_progress();
  }


  RunLog &
  RunLog::operator<<(std::ostream &(*manipulator)(std::ostream &))
  {
    std::ostringstream text;
    text << manipulator;
    write(text.str());
    file.flush();
    if (to_terminal)
      std::cout.flush();
    return *this;
  }


  void
  RunLog::write(const std::string &text)
  {
    if (!active)
      return;
    if (live_line_shown)
      {
        std::cout << "\r\033[K";
        live_line_shown = false;
      }
    if (file.is_open())
      file << text;
    else
      before_file += text;
    if (to_terminal)
      std::cout << text;
  }


  void
  RunLog::warning(const std::string &text)
  {
    *this << "Advice: " << text << std::endl;
  }


  void
  RunLog::progress(const double             fraction,
                   const double             time,
                   const unsigned long long step)
  {
    if (!active)
      return;
    const Clock::time_point now   = Clock::now();
    const int               tenth = static_cast<int>(
        10. *
        std::min(1., std::max(0., std::isfinite(fraction) ? fraction : 0.)));
    const bool to_log = tenth > last_tenth;
    const bool live =
        live_line_allowed && seconds_between(last_shown, now) > 0.2;
    if (first_fraction < 0.)
      {
        first_fraction = fraction;
        first_step     = step;
      }
    if (!to_log && !live)
      return;

    const double elapsed = seconds_between(progress_begin, now);
    std::string  text    = formatted("%3.0f %%  t = %.4g ms  step %llu",
                                 100. * std::min(1., fraction),
                                 1e3 * time,
                                 step);
    if (elapsed > 0. && step > first_step)
      text += formatted("  %.0f steps/s", (step - first_step) / elapsed);
    if (const double done = fraction - first_fraction;
        done > 1e-4 && fraction < 1.)
      text += "  " + duration_text(elapsed / done * (1. - fraction)) + " left";

    if (to_log)
      {
        last_tenth = tenth;
        if (live_line_allowed)
          file << text << std::endl;
        else
          *this << text << std::endl;
      }
    if (live)
      {
        std::cout << "\r" << text << "\033[K" << std::flush;
        live_line_shown = true;
        last_shown      = now;
      }
  }


  void
  RunLog::end_progress()
  {
    if (live_line_shown)
      std::cout << "\r\033[K" << std::flush;
    live_line_shown = false;
    last_tenth      = -1;
    first_fraction  = -1.;
    progress_begin  = Clock::now();
  }


  double &
  RunLog::seconds_of(const char *name)
  {
    for (Part &part : parts)
      if (part.literal == name || part.name == name)
        {
          part.literal = name;
          return part.seconds;
        }
    parts.push_back({name, name, 0.});
    return parts.back().seconds;
  }


  std::vector<std::pair<std::string, double>>
  RunLog::wall_times() const
  {
    std::vector<std::pair<std::string, double>> result;
    for (const Part &part : parts)
      result.emplace_back(part.name, part.seconds);
    return result;
  }


  double
  RunLog::wall_time() const
  {
    return seconds_before + seconds_between(begin, Clock::now());
  }


  void
  RunLog::exchange_state(StateArchive &state)
  {
    double                   whole = wall_time();
    std::vector<std::string> names;
    std::vector<double>      seconds;
    for (const Part &part : parts)
      {
        names.push_back(part.name);
        seconds.push_back(part.seconds);
      }
    state.same(whole, loop_begin, names, seconds);
    if (!state.loads())
      return;
    seconds_before += whole;
    for (std::size_t k = 0; k < names.size(); ++k)
      {
        const auto part =
            std::find_if(parts.begin(), parts.end(), [&](const Part &p) {
              return p.name == names[k];
            });
        if (part != parts.end())
          part->seconds += seconds[k];
        else
          parts.push_back({names[k], nullptr, seconds[k]});
      }
  }


  void
  RunLog::print_wall_times()
  {
    const double whole = wall_time();
    *this << formatted("%-28s %10s %8s\n", "Wall time", "s", "share");
    for (const Part &part : parts)
      *this << formatted("%-28s %10.3f %6.1f %%\n",
                         part.name.c_str(),
                         part.seconds,
                         whole > 0. ? 100. * part.seconds / whole : 0.);
    *this << formatted("%-28s %10.3f %6.1f %%\n", "whole run", whole, 100.)
          << std::flush;
  }
} // namespace Morsel
