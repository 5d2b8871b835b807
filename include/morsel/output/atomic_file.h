#ifndef morsel_output_atomic_file_h
#define morsel_output_atomic_file_h

#include <morsel/core/atomic_file.h>

namespace Morsel::Output
{
  using Morsel::create_folder;
  using Morsel::write_atomically;
} // namespace Morsel::Output

#endif
