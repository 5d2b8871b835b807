// How the ranks agree on what fails and which bonds are cut.

#include <morsel/core/gather.h>
#include <morsel/sph/damage_evolution.h>

#include <algorithm>

namespace Morsel::SPH
{
  namespace
  {
    /// A particle that fails.
    struct Failing
    {
      unsigned long long id;
      double             area; ///< [m^2]
    };
  } // namespace


  void
  DamageEvolution::exchange_ghosts_start()
  {
    // Energies at the end of the coming step need the ghosts' motion in it.
    ranks->exchange_start(dealii::make_array_view(particles.half_velocity), 0);
    ranks->exchange_start(dealii::make_array_view(particles.acceleration), 1);
    if (average_stress)
      ranks->exchange_start(dealii::make_array_view(particles.effective), 2);
  }


  void
  DamageEvolution::exchange_ghosts_finish()
  {
    ranks->exchange_finish(dealii::make_array_view(particles.half_velocity), 0);
    ranks->exchange_finish(dealii::make_array_view(particles.acceleration), 1);
    if (average_stress)
      ranks->exchange_finish(dealii::make_array_view(particles.effective), 2);
  }


  void
  DamageEvolution::bound_ghosts()
  {
    std::fill(particles.strongest.begin() + particles.n_groups(),
              particles.strongest.end(),
              0.);
    for (unsigned int i = particles.n_owned; i < particles.n_local; ++i)
      if (!particles.failed[i])
        {
          double &bound = particles.strongest[i / group_size];
          bound         = std::max(bound,
                           Materials::driver_value(
                               law, material, particles.effective[i], true));
        }
  }


  bool
  DamageEvolution::take_batch_of_all_ranks()
  {
    std::vector<Failing> failing;
    for (const unsigned int i : failed_now)
      failing.push_back({particles.id[i], particles.area[i]});
    failing = gather(failing, ranks->communicator());

    // In the order that one rank alone would take.
    std::sort(failing.begin(),
              failing.end(),
              [](const Failing &a, const Failing &b) { return a.id < b.id; });
    batch.clear();
    for (const Failing &one : failing)
      {
        failed_area += one.area;
        if (const long i = local.find(one.id); i >= 0)
          batch.push_back(i);
      }
    return !failing.empty();
  }


  void
  DamageEvolution::agree_on_cuts()
  {
    for (;;)
      {
        const auto told = gather(cut_pairs, ranks->communicator());
        cut_pairs.clear();
        if (told.empty())
          return;
        for (const auto &[first, second] : told)
          {
            const long i = local.find(first), j = local.find(second);
            const long k = i < 0 || j < 0 ? -1 : bonds.find(i, j);
            if (k < 0 || !bonds.live[k])
              continue;
            cut(k, i);
            suspects.push_back(i);
            suspects.push_back(j);
          }
        clear_suspects();
      }
  }
} // namespace Morsel::SPH
