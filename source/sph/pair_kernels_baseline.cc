#define MORSEL_INSTRUCTION_SET baseline
#define MORSEL_LANES 2
#include <morsel/sph/pair_kernels_table.h>
