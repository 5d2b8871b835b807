#include <morsel/core/parallel.h>
#include <morsel/sph/granular.h>

#include <algorithm>

namespace Morsel::SPH
{
  namespace
  {
    /// The list reaches this share of the support further than needed.
    constexpr double skin = 0.15;

    /// Contact diameter of a grain over that of live material: grains
    /// may be packed closer than the lattice before they repel.
    constexpr double grain_diameter = 0.8;
  } // namespace


  bool
  Granular::moved_far()
  {
    return watch.beyond(
        0.5 * skin * kernel.support(), particles.travelled, [&] {
          double largest = 0.;
          for (unsigned int m = 0; m < members.size(); ++m)
            largest = std::max(
                largest,
                (particles.position(members[m]) - built_at[m]).norm_square());
          return largest;
        });
  }


  void
  Granular::rebuild_list()
  {
    std::vector<unsigned int> candidates;
    built_at.clear();
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      if (particles.failed[i] || exposed[i] || on_surface[i])
        {
          candidates.push_back(i);
          built_at.push_back(particles.position(i));
        }
    grid.build(built_at, (1. + skin) * kernel.support());

    const unsigned int n = candidates.size();
    members.resize(n);
    member_failed.resize(n);
    for (unsigned int m = 0; m < n; ++m)
      {
        members[m]       = candidates[grid.sorted()[m]];
        built_at[m]      = particles.position(members[m]);
        member_failed[m] = particles.failed[members[m]];
      }

    blocks.resize((n + block_size - 1) / block_size);
    parallel_for(
        blocks.size(),
        [&](unsigned int begin, unsigned int end) {
          for (unsigned int b = begin; b < end; ++b)
            {
              blocks[b].first = b * block_size;
              blocks[b].last  = std::min(n, (b + 1) * block_size);
              fill_block(blocks[b]);
            }
        },
        1);

    // The dummy that fills up rows is out of reach of everything.
    motion.resize(n + 1);
    member_stress.resize(n + 1);
    area.resize(n + 1);
    size.resize(n + 1);
    mass.resize(n + 1);
    motion[n]        = {1e30, 1e30, 0., 0.};
    member_stress[n] = {0., 0., 0., 0.};
    size[n]          = {0., 0.};
    area[n] = mass[n] = 0.;
    for (unsigned int m = 0; m < n; ++m)
      {
        const unsigned int i = members[m];
        size[m]              = {(member_failed[m] ? grain_diameter : 1.) *
                                    contact_diameter[i],
                                particles.area[i]};
        mass[m]              = particles.mass[i];
      }
    stale = false;
    watch.begin(particles.travelled);
  }


  void
  Granular::fill_block(Block &block) const
  {
    // Live pairs touch at one spacing, pairs with a grain within the support.
    const double reach       = skin * kernel.support();
    const double grain_reach = kernel.support() + reach;
    const double live_reach  = particles.spacing + reach;
    block.grain_start.assign(1, 0);
    block.live_start.assign(1, 0);
    block.grain_pair.clear();
    block.live_pair.clear();
    for (unsigned int m = block.first; m < block.last; ++m)
      {
        const dealii::Point<2> x = built_at[m];
        grid.for_each_run(
            x, [&](const unsigned int begin, const unsigned int end) {
              for (unsigned int n = begin; n < end; ++n)
                {
                  const double r2    = (built_at[n] - x).norm_square();
                  const bool   grain = member_failed[m] || member_failed[n];
                  if (r2 >= grain_reach * grain_reach || n == m)
                    continue;
                  if (grain)
                    block.grain_pair.push_back(n);
                  else if (r2 < live_reach * live_reach)
                    {
                      const long k = bonds.find(members[m], members[n]);
                      if (k < 0 || !bonds.live[k])
                        block.live_pair.push_back(n);
                    }
                }
            });
        while (block.grain_pair.size() % kernels.lanes != 0)
          block.grain_pair.push_back(members.size());
        block.grain_start.push_back(block.grain_pair.size());
        block.live_start.push_back(block.live_pair.size());
      }
  }
} // namespace Morsel::SPH
