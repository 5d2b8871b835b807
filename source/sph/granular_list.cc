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


  double
  Granular::largest_reach() const
  {
    return (1. + skin) * kernel.support();
  }


  bool
  Granular::moved_far()
  {
    const bool far =
        watch.beyond(0.5 * skin * kernel.support(), particles.travelled, [&] {
          double largest = 0.;
          for (unsigned int m = 0; m < members.size(); ++m)
            largest = std::max(
                largest,
                (particles.position(members[m]) - built_at[m]).norm_square());
          return largest;
        });
    return ranks ? ranks->maximum(far) > 0. : far;
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
    grid.build(built_at, largest_reach());

    const unsigned int n = candidates.size();
    members.resize(n);
    member_failed.resize(n);
    for (unsigned int m = 0; m < n; ++m)
      {
        members[m]       = candidates[grid.sorted()[m]];
        built_at[m]      = particles.position(members[m]);
        member_failed[m] = particles.failed[members[m]];
      }
    if (exchange)
      find_foreign();

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

    // The dummy is out of reach of everything.
    const unsigned int last = dummy();
    motion.resize(last + 1);
    member_stress.resize(last + 1);
    area.resize(last + 1);
    size.resize(last + 1);
    mass.resize(last + 1);
    motion[last]        = {1e30, 1e30, 0., 0.};
    member_stress[last] = {0., 0., 0., 0.};
    size[last]          = {0., 0.};
    area[last] = mass[last] = 0.;
    for (unsigned int m = 0; m < n; ++m)
      {
        size[m] = member_size(m);
        mass[m] = particles.mass[members[m]];
      }
    for (unsigned int f = 0; f < foreign.size(); ++f)
      {
        size[n + f] = foreign[f].size;
        mass[n + f] = foreign[f].mass;
      }
    stale = false;
    watch.begin(particles.travelled);
  }


  GrainSize
  Granular::member_size(const unsigned int m) const
  {
    const unsigned int i = members[m];
    return {(member_failed[m] ? grain_diameter : 1.) * contact_diameter[i],
            particles.area[i]};
  }


  void
  Granular::fill_block(Block &block) const
  {
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
                if (n != m)
                  add_pair(block, m, n, (built_at[n] - x).norm_square());
            });
        if (exchange)
          for (unsigned int k = foreign_near.start[m];
               k < foreign_near.start[m + 1];
               ++k)
            {
              const unsigned int f = foreign_near.index[k];
              add_pair(block,
                       m,
                       members.size() + f,
                       (foreign[f].place - x).norm_square());
            }
        while (block.grain_pair.size() % kernels.lanes != 0)
          block.grain_pair.push_back(dummy());
        block.grain_start.push_back(block.grain_pair.size());
        block.live_start.push_back(block.live_pair.size());
      }
  }


  void
  Granular::add_pair(Block             &block,
                     const unsigned int m,
                     const unsigned int n,
                     const double       r2) const
  {
    // Live pairs touch at one spacing, pairs with a grain within the support.
    const double reach       = skin * kernel.support();
    const double grain_reach = kernel.support() + reach;
    const double live_reach  = particles.spacing + reach;
    if (r2 >= grain_reach * grain_reach)
      return;
    if (member_failed[m] || member_failed[n])
      block.grain_pair.push_back(n);
    else if (r2 < live_reach * live_reach && unbonded(m, n))
      block.live_pair.push_back(n);
  }


  bool
  Granular::unbonded(const unsigned int m, const unsigned int n) const
  {
    // A member of another rank that this one does not know was never bonded.
    const long other = n < members.size()
                           ? static_cast<long>(members[n])
                           : local.find(foreign[n - members.size()].id);
    const long k     = other < 0 ? -1 : bonds.find(members[m], other);
    return k < 0 || !bonds.live[k];
  }
} // namespace Morsel::SPH
