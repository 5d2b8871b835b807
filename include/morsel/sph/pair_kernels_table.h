#ifndef morsel_sph_pair_kernels_table_h
#define morsel_sph_pair_kernels_table_h

// The table of one instruction set.

#include <morsel/sph/driver_kernels.h>
#include <morsel/sph/energy_kernels.h>
#include <morsel/sph/force_kernels.h>
#include <morsel/sph/grain_kernels.h>
#include <morsel/sph/softening_kernels.h>

#define MORSEL_TEXT_OF(name) #name
#define MORSEL_TEXT(name) MORSEL_TEXT_OF(name)

namespace Morsel::SPH::MORSEL_INSTRUCTION_SET
{
  const PairKernels &
  kernels()
  {
    static constexpr PairKernels table = {
        MORSEL_TEXT(MORSEL_INSTRUCTION_SET),
        lanes,
        {fill_columns<false>, fill_columns<true>},
        {{strain_loop<false, intact>,
          strain_loop<false, softened_deviator>,
          strain_loop<false, softened_principal>},
         {strain_loop<true, intact>,
          strain_loop<true, softened_deviator>,
          strain_loop<true, softened_principal>}},
        {strain_loop<false, intact, Gradient::own_fit>,
         strain_loop<true, intact, Gradient::own_fit>},
        {{strain_loop<false, intact, Gradient::conforming>,
          strain_loop<false, softened_deviator, Gradient::conforming>,
          strain_loop<false, softened_principal, Gradient::conforming>},
         {strain_loop<true, intact, Gradient::conforming>,
          strain_loop<true, softened_deviator, Gradient::conforming>,
          strain_loop<true, softened_principal, Gradient::conforming>}},
        {{energy_loop<false, false>, energy_loop<false, true>},
         {energy_loop<true, false>, energy_loop<true, true>}},
        {{force_loop<false, false>, force_loop<false, true>},
         {force_loop<true, false>, force_loop<true, true>}},
        {{force_loop<false, false, Gradient::conforming>,
          force_loop<false, true, Gradient::conforming>},
         {force_loop<true, false, Gradient::conforming>,
          force_loop<true, true, Gradient::conforming>}},
        {own_driver<tensile_stress>,
         own_driver<extension_strain>,
         own_driver<modified_von_mises>},
        {average_driver<tensile_stress>,
         average_driver<extension_strain>,
         average_driver<modified_von_mises>},
        {{soften_group<tensile_stress, false>,
          soften_group<tensile_stress, true>},
         {soften_group<extension_strain, false>,
          soften_group<extension_strain, true>},
         {soften_group<modified_von_mises, false>,
          soften_group<modified_von_mises, true>}},
        {grain_force<false>, grain_force<true>},
        {grain_rate<false>, grain_rate<true>}};
    return table;
  }
} // namespace Morsel::SPH::MORSEL_INSTRUCTION_SET

#endif
