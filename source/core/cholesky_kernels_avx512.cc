#define MORSEL_INSTRUCTION_SET avx512
#define MORSEL_LANES 8
#include <morsel/core/cholesky_kernels_table.h>
