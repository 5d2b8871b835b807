#define MORSEL_INSTRUCTION_SET avx2
#define MORSEL_LANES 4
#include <morsel/core/cholesky_kernels_table.h>
