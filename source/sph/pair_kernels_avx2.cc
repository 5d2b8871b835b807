#define MORSEL_INSTRUCTION_SET avx2
#define MORSEL_LANES 4
#include <morsel/sph/pair_kernels_table.h>
