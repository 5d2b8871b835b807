#ifndef morsel_core_errors_h
#define morsel_core_errors_h

#include <stdexcept>

namespace Morsel
{
  /// The exit status of the program, as users and scripts rely on it.
  enum class ExitStatus
  {
    done        = 0,
    fault       = 1, ///< a fault of the program
    bad_input   = 2,
    bad_numbers = 3,
    bad_files   = 4, ///< or no memory left
    interrupted = 130
  };


  /// A mistake in what the user gave: one sentence that says what, where,
  /// which value and what is allowed. Ends the program with status 2.
  struct InputError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };


  /// The numbers went bad: which quantity, where, when, what to change.
  /// Ends the program with status 3.
  struct NumericalError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };


  /// Reading or writing failed. Ends the program with status 4.
  struct FileError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };


  /// SIGINT or SIGTERM arrived. Ends the program with status 130.
  struct Interrupted : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
} // namespace Morsel

#endif
