// How a failure of all ranks becomes an exit status.
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/signals.h>

#include <boost/test/unit_test.hpp>

#include <csignal>

using namespace Morsel;


BOOST_AUTO_TEST_SUITE(failure)

// The rank that ends first has mpirun send SIGTERM to the others, who have
// nothing to add to the sentence of the failure.
BOOST_AUTO_TEST_CASE(interruption_after_failure_is_silent)
{
  struct sigaction usual, of_work, of_failed;
  sigaction(SIGTERM, nullptr, &usual);
  end_on_signals();
  sigaction(SIGTERM, nullptr, &of_work);
  BOOST_TEST(exit_status_of([] { throw InputError("Said once."); }) ==
             static_cast<int>(ExitStatus::bad_input));
  sigaction(SIGTERM, nullptr, &of_failed);
  BOOST_TEST((of_failed.sa_handler != of_work.sa_handler));
  BOOST_TEST((of_failed.sa_handler != SIG_DFL));
  sigaction(SIGTERM, &usual, nullptr);
  sigaction(SIGINT, &usual, nullptr);
  sigaction(SIGUSR1, &usual, nullptr);
}

BOOST_AUTO_TEST_SUITE_END()
