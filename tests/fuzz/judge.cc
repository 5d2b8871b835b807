#include "judge.h"
#include "gallery.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <sstream>

namespace Fuzz
{
  namespace
  {
    bool
    contains(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }


    /// What keeps a message from being one clear sentence on a terminal.
    std::string
    complaint_on_message(const std::string &message)
    {
      // A sentence for each mistake that was found, each in a line.
      const std::vector<std::string> sentences = split_lines(message);
      for (const std::string &sentence : sentences)
        if (sentence.rfind("morsel: ", 0) != 0)
          return "a line that does not begin with 'morsel: '";
      if (sentences.empty())
        return "no sentence that tells why";
      if (sentences.size() > 20 ||
          message.size() > 800 * sentences.size() + 1200)
        return "the message is too long (" + std::to_string(message.size()) +
               " bytes)";
      const std::size_t end = message.find_last_not_of('\n');
      if (message[end] != '.' && message[end] != '?' && message[end] != ')')
        return "the message is no full sentence";
      for (const char *const bad : {"'?.", "..\n"})
        if (contains(message, bad))
          return std::string("the message has '") + bad + "'";
      for (const char *const bad :
           {"A fault inside", "Stacktrace", "terminate called", "Exc"})
        if (contains(message, bad))
          return std::string("the message tells of '") + bad + "'";
      for (const char c : message)
        if ((static_cast<unsigned char>(c) < 32 && c != '\n') || c == 127)
          return "the message has a control character";
      return "";
    }


    bool
    is_promised(const int status)
    {
      const std::array<int, 4> promised = {{0, 2, 3, 4}};
      return std::count(promised.begin(), promised.end(), status) > 0;
    }


    /// What an address, thread or undefined behaviour sanitizer has reported,
    /// on the process or on the runs of a study; the first line of it.
    std::string
    report_of_sanitizer(const Outcome &outcome)
    {
      for (const std::string &line :
           split_lines(outcome.errors + "\n" + outcome.run_errors))
        if (contains(line, "ERROR: AddressSanitizer") ||
            contains(line, "WARNING: ThreadSanitizer") ||
            contains(line, ": runtime error: "))
          return line;
      return "";
    }


    /// The address sanitizer's operator new() ends the process where else an
    /// exception is thrown and the status is 4.
    bool
    tells_of_memory_used_up(const std::string &report)
    {
      return contains(report, "out of memory") ||
             contains(report, "exceeds maximum supported size");
    }


    /// Runs of a study that ended as no run may, by the lines that the study
    /// writes about them.
    std::string
    complaint_on_runs(const Outcome &outcome)
    {
      for (const std::string &line :
           split_lines(outcome.output + "\n" + outcome.errors))
        for (const std::string failed : {": failed, ", " failed with "})
          if (const std::size_t at = line.find(failed); at != std::string::npos)
            {
              const std::string  why = line.substr(at + failed.size());
              std::istringstream words(why);
              std::string        word;
              int                status = 0;
              words >> word >> status;
              if (word == "signal" ||
                  (word == "status" && !is_promised(status)))
                return "a run of it failed, " + why;
            }
      return "";
    }


    /// Files that may not be written, or not at all.
    std::string
    complaint_on_files(const Outcome &outcome, const bool nothing_allowed)
    {
      for (const std::string &change : outcome.changes)
        {
          const bool result = change.rfind("written: output", 0) == 0 ||
                              change.rfind("written: results", 0) == 0;
          if (!result)
            return change + ", outside of the folder of results";
          if (nothing_allowed)
            return change + ", though nothing may be written";
        }
      return "";
    }
  } // namespace


  std::string
  complaint(const Mutation &mutation,
            const Outcome  &outcome,
            const bool      validated)
  {
    if (const std::string report = report_of_sanitizer(outcome);
        !report.empty())
      return tells_of_memory_used_up(report) ? "" : report;
    if (outcome.killed)
      return outcome.interrupted ? "it did not end when interrupted"
                                 : "it took too long";
    if (outcome.signal == SIGTERM && outcome.interrupted)
      return complaint_on_files(outcome, validated);
    if (outcome.signal != 0)
      return "signal " + std::to_string(outcome.signal) + " ended it";

    const bool done = outcome.interrupted && outcome.status == 130;
    if (!done && !is_promised(outcome.status))
      return "exit status " + std::to_string(outcome.status);
    if (const std::string text = complaint_on_runs(outcome); !text.empty())
      return text;
    if (outcome.status != 0 && !done)
      if (const std::string text = complaint_on_message(outcome.errors);
          !text.empty())
        return text;
    if (outcome.status == 0 && mutation.unknown_name)
      return "accepted with an unknown entry";
    // What the formulas of a study may name is known when each series has run.
    const bool after_runs = contains(outcome.errors, "which no run gives");
    return complaint_on_files(
        outcome, validated || (outcome.status == 2 && !after_runs));
  }
} // namespace Fuzz
