#include <morsel/core/machine.h>

#include <unistd.h>

namespace Morsel
{
  double
  machine_memory()
  {
    return 1. * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGE_SIZE);
  }
} // namespace Morsel
