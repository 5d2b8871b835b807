#include <morsel/core/parallel.h>
#include <morsel/sph/granular.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Morsel::SPH
{
  namespace
  {
    /// A member may move by this share of the support, and by what it covers
    /// in so many steps at its speed, before the list is built anew; but no
    /// further than the largest share.
    constexpr double       least_allowance = 0.02, largest_allowance = 0.2;
    constexpr unsigned int steps_allowed = 40;

    /// Contact diameter of a grain over that of live material: grains
    /// may be packed closer than the lattice before they repel.
    constexpr double grain_diameter = 0.8;
  } // namespace


  double
  Granular::allowance_of(const unsigned int i, const double time_step) const
  {
    const Vector2 v = particles.half_velocity[i];
    return std::min(least_allowance * kernel.support() +
                        steps_allowed * time_step * std::hypot(v.x, v.y),
                    largest_allowance * kernel.support());
  }


  void
  Granular::rebuild_list(const double time_step)
  {
    std::vector<unsigned int> candidates;
    built_at.clear();
    longest_allowance = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      if (particles.failed[i] || exposed[i] || on_surface[i])
        {
          candidates.push_back(i);
          built_at.push_back(particles.position(i));
          longest_allowance =
              std::max(longest_allowance, allowance_of(i, time_step));
        }
    if (ranks)
      longest_allowance = ranks->maximum(longest_allowance);
    const double reach = kernel.support() + 2. * longest_allowance;
    grid.build(built_at, reach);

    const unsigned int n = candidates.size();
    n_in_grid            = n;
    members.resize(n);
    member_failed.assign(first_foreign(), 0);
    allowance.assign(first_foreign(), 0.);
    for (unsigned int m = 0; m < n; ++m)
      {
        members[m]       = candidates[grid.sorted()[m]];
        built_at[m]      = particles.position(members[m]);
        member_failed[m] = particles.failed[members[m]];
        allowance[m]     = allowance_of(members[m], time_step);
      }
    if (exchange)
      find_foreign(reach);
    number_members();

    // The dummy is out of reach of everything.
    dummy            = first_foreign() + foreign.size();
    const auto empty = [&](auto &values, const auto &far) {
      values.clear();
      values.resize(dummy + 1, far);
    };
    empty(motion, GrainMotion{1e30, 1e30, 0., 0.});
    empty(member_stress, GrainStress{0., 0., 0., 0.});
    empty(size, GrainSize{0., 0.});
    empty(area, 0.);
    empty(mass, 0.);
    for (unsigned int m = 0; m < n; ++m)
      {
        size[m] = member_size(m);
        mass[m] = particles.mass[members[m]];
      }
    for (unsigned int f = 0; f < foreign.size(); ++f)
      {
        size[first_foreign() + f] = foreign[f].size;
        mass[first_foreign() + f] = foreign[f].mass;
      }

    blocks.clear();
    add_blocks(0);
    fill_blocks([](const Block &) { return true; });
    changed.clear();
    stale = false;
  }


  void
  Granular::number_members()
  {
    number.assign(particles.n_owned, nobody);
    for (unsigned int m = 0; m < members.size(); ++m)
      number[members[m]] = m;
  }


  void
  Granular::add_blocks(unsigned int first)
  {
    while (first < members.size())
      {
        blocks.emplace_back();
        blocks.back().first = first;
        first = std::min<unsigned int>(first + block_size, members.size());
        blocks.back().last = first;
      }
  }


  template <typename Predicate>
  void
  Granular::fill_blocks(const Predicate &is_meant)
  {
    std::vector<unsigned int> meant;
    for (unsigned int b = 0; b < blocks.size(); ++b)
      if (is_meant(blocks[b]))
        meant.push_back(b);
    parallel_for(
        meant.size(),
        [&](unsigned int begin, unsigned int end) {
          for (unsigned int k = begin; k < end; ++k)
            fill_block(blocks[meant[k]]);
        },
        1);
  }


  bool
  Granular::amend_list(const double time_step)
  {
    if (changed.empty())
      return true;
    if (exchange && change_concerns_others())
      return false;
    const unsigned int n_before = members.size();
    for (const unsigned int i : changed)
      if (number[i] == nobody)
        {
          const unsigned int m = members.size();
          if (m == first_foreign())
            return false;
          number[i] = m;
          members.push_back(i);
          built_at.push_back(particles.position(i));
          member_failed[m] = 0;
          allowance[m] =
              std::min(allowance_of(i, time_step), longest_allowance);
          mass[m] = particles.mass[i];
        }
    while (!blocks.empty() && blocks.back().last > n_in_grid)
      blocks.pop_back();
    const unsigned int n_blocks = blocks.size();
    add_blocks(n_in_grid);

    // Members whose pairs are others now.
    std::vector<char> affected(members.size(), 0);
    for (const unsigned int i : changed)
      {
        const unsigned int m   = number[i];
        const bool         now = particles.failed[i];
        if (now != member_failed[m] || m >= n_before)
          grid.for_each_run(
              built_at[m],
              [&](const unsigned int begin, const unsigned int end) {
                std::fill(affected.begin() + begin, affected.begin() + end, 1);
              });
        affected[m]      = 1;
        member_failed[m] = now;
        size[m]          = member_size(m);
      }
    changed.clear();
    fill_blocks([&](const Block &block) {
      return &block - blocks.data() >= n_blocks ||
             std::any_of(affected.begin() + block.first,
                         affected.begin() + block.last,
                         [](const char a) { return a != 0; });
    });
    return true;
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
    PairsOfMembers pairs;
    block.live_start.assign(1, 0);
    for (unsigned int m = block.first; m < block.last; ++m)
      {
        const dealii::Point<2> x = built_at[m];
        grid.for_each_run(
            x, [&](const unsigned int begin, const unsigned int end) {
              for (unsigned int n = begin; n < end; ++n)
                if (n != m)
                  add_pair(block, pairs, m, n, (built_at[n] - x).norm_square());
            });
        for (unsigned int n = n_in_grid; n < members.size(); ++n)
          if (n != m)
            add_pair(block, pairs, m, n, (built_at[n] - x).norm_square());
        if (exchange && m < n_in_grid)
          for (unsigned int k = foreign_near.start[m];
               k < foreign_near.start[m + 1];
               ++k)
            {
              const unsigned int f = foreign_near.index[k];
              add_pair(block,
                       pairs,
                       m,
                       first_foreign() + f,
                       (foreign[f].place - x).norm_square());
            }
        block.live_start.push_back(pairs.live.size());
      }
    block.live_pair = pairs.live;
    lay_out(block, pairs);
  }


  void
  Granular::add_pair(const Block       &block,
                     PairsOfMembers    &pairs,
                     const unsigned int m,
                     const unsigned int n,
                     const double       r2) const
  {
    // Live pairs touch at one spacing, pairs with a grain within the support.
    const double reach       = allowance[m] + allowance[n];
    const double grain_reach = kernel.support() + reach;
    const double live_reach  = particles.spacing + reach;
    if (r2 >= grain_reach * grain_reach)
      return;
    if (member_failed[m] || member_failed[n])
      pairs.grain[m - block.first].push_back(n);
    else if (r2 < live_reach * live_reach && unbonded(m, n))
      pairs.live.push_back(n);
  }


  void
  Granular::lay_out(Block &block, const PairsOfMembers &pairs) const
  {
    // Rows of about the same length share a group.
    const auto n_pairs = [&](const unsigned int m) {
      return pairs.grain[m - block.first].size();
    };
    block.row.clear();
    block.n_grains = 0;
    for (unsigned int m = block.first; m < block.last; ++m)
      if (member_failed[m] || n_pairs(m) > 0)
        {
          block.row.push_back(m);
          block.n_grains += member_failed[m] != 0;
        }
    std::sort(block.row.begin(),
              block.row.end(),
              [&](const unsigned int m, const unsigned int n) {
                return std::make_tuple(!member_failed[m], n_pairs(n), m) <
                       std::make_tuple(!member_failed[n], n_pairs(m), n);
              });
    block.n_rows = block.row.size();

    block.slot_begin.assign(1, 0);
    block.grain_pair.clear();
    for (unsigned int begin = 0; begin < block.n_rows; begin += group_size)
      {
        const unsigned int end  = std::min(begin + group_size, block.n_rows);
        std::size_t        most = 0;
        for (unsigned int r = begin; r < end; ++r)
          most = std::max(most, n_pairs(block.row[r]));
        const unsigned int first = block.grain_pair.size();
        block.grain_pair.resize(first + most * group_size, dummy);
        for (unsigned int r = begin; r < end; ++r)
          {
            const auto &row = pairs.grain[block.row[r] - block.first];
            for (unsigned int k = 0; k < row.size(); ++k)
              block.grain_pair[first + k * group_size + r - begin] = row[k];
          }
        block.slot_begin.push_back(block.grain_pair.size() / group_size);
      }
    while (block.row.size() % group_size != 0)
      block.row.push_back(block.row.back());
  }


  bool
  Granular::unbonded(const unsigned int m, const unsigned int n) const
  {
    // A member of another rank that this one does not know was never bonded.
    const long other = n < first_foreign()
                           ? static_cast<long>(members[n])
                           : local.find(foreign[n - first_foreign()].id);
    const long k     = other < 0 ? -1 : bonds.find(members[m], other);
    return k < 0 || !bonds.live[k];
  }
} // namespace Morsel::SPH
