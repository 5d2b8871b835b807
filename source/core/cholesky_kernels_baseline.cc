#define MORSEL_INSTRUCTION_SET baseline
#define MORSEL_LANES 2
#include <morsel/core/cholesky_kernels_table.h>
