// The one translation unit that holds Boost.Test's main(); MPI and deal.II's
// threads are set up once for all unit tests.
#define BOOST_TEST_MODULE morsel
#define BOOST_TEST_NO_MAIN
#include <deal.II/base/mpi.h>

#include <boost/test/unit_test.hpp>

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 2);
  return boost::unit_test::unit_test_main(init_unit_test, argc, argv);
}
