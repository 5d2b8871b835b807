#include <morsel/sph/bonds.h>
#include <morsel/sph/lattice_groups.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// By so little the pairs of a lattice may differ, relative to the spacing
    /// and to the largest weight: coordinates are rounded.
    constexpr double lattice_tolerance = 1e-9;


    /// Entries of row @p i without those at the very edge of the support,
    /// whose weight is nothing and which rounding may leave out.
    void
    find_entries(const Bonds               &bonds,
                 const unsigned int         i,
                 std::vector<unsigned int> &entries)
    {
      entries.clear();
      const unsigned int begin   = bonds.list.start[i];
      const unsigned int end     = bonds.list.start[i + 1];
      double             largest = 0.;
      for (unsigned int k = begin; k < end; ++k)
        largest = std::max(largest, bonds.weight[k]);
      for (unsigned int k = begin; k < end; ++k)
        if (bonds.weight[k] > lattice_tolerance * largest)
          entries.push_back(k);
    }
  } // namespace


  void
  LatticeGroups::find(const Particles   &particles,
                      Bonds             &bonds,
                      const unsigned int first_without_ghosts)
  {
    const unsigned int n_groups = particles.n_groups();
    n_owned                     = particles.n_owned;
    use.assign(n_groups, 0);
    // At a cut between ranks rows are in another order than the pattern's.
    for (unsigned int g = 0; g < n_groups && x.empty(); ++g)
      make_pattern(particles, bonds, g * group_size);
    for (unsigned int g = 0; g < n_groups && !x.empty(); ++g)
      if (fits(particles, bonds, g))
        {
          use[g] = regular;
          ++n_regular;
        }
    if (n_regular == 0)
      {
        use = {};
        return;
      }

    const unsigned int n_twos = x.size();
    first.assign(2 * n_twos * n_groups, 0);
    std::vector<unsigned int> entries;
    for (unsigned int g = 0; g < n_groups; ++g)
      {
        if (use[g] & regular)
          {
            find_entries(bonds, g * group_size, entries);
            in_order(particles, bonds, g * group_size, entries);
            for (unsigned int t = 0; t < n_twos; ++t)
              {
                unsigned int *const two = &first[2 * (g * n_twos + t)];
                two[0] = bonds.list.index[entries[2 * n_twos - 1 - t]];
                two[1] = bonds.list.index[entries[t]];
              }
          }
        mark_neighbours(
            bonds.list, g, use[g] & regular ? needs_columns : needs_records);
      }
    for (unsigned int g = 0; g * group_size < first_without_ghosts; ++g)
      use[g] |= needs_records;
    for (unsigned int i = 0; i < bonds.list.n_rows(); ++i)
      adjust_weights(particles, bonds, i);
    for (auto &column : columns)
      column.resize(std::max(n_groups * group_size, particles.n_local), 0.);
  }


  bool
  LatticeGroups::fits(const Particles   &particles,
                      const Bonds       &bonds,
                      const unsigned int g) const
  {
    const unsigned int begin = g * group_size;
    if (begin + group_size > particles.n_owned)
      return false;
    std::vector<unsigned int> of_first, entries;
    find_entries(bonds, begin, of_first);
    if (!in_order(particles, bonds, begin, of_first))
      return false;
    for (unsigned int i = begin; i < begin + group_size; ++i)
      {
        find_entries(bonds, i, entries);
        if (!in_order(particles, bonds, i, entries))
          return false;
        for (unsigned int k = 0; k < entries.size(); ++k)
          if (bonds.list.index[entries[k]] !=
              bonds.list.index[of_first[k]] + (i - begin))
            return false;
      }
    return true;
  }


  bool
  LatticeGroups::in_order(const Particles           &particles,
                          const Bonds               &bonds,
                          const unsigned int         i,
                          std::vector<unsigned int> &entries) const
  {
    const unsigned int n = 2 * x.size();
    if (entries.size() != n)
      return false;
    for (unsigned int k = 0; k < n; ++k)
      {
        unsigned int found = k;
        while (found < n && !is_pair(bonds.offset(particles, i, entries[found]),
                                     bonds.weight[entries[found]],
                                     k))
          ++found;
        if (found == n)
          return false;
        std::swap(entries[k], entries[found]);
      }
    return true;
  }


  bool
  LatticeGroups::is_pair(const Vector2     &offset,
                         const double       weight_of_pair,
                         const unsigned int k) const
  {
    const unsigned int n_twos = x.size();
    const bool         back   = k < n_twos;
    const unsigned int t      = back ? k : 2 * n_twos - 1 - k;
    const double       sign   = back ? -1. : 1.;
    return std::abs(offset.x - sign * x[t]) < lattice_tolerance * spacing &&
           std::abs(offset.y - sign * y[t]) < lattice_tolerance * spacing &&
           std::abs(weight_of_pair - weight[t]) < lattice_tolerance * heaviest;
  }


  void
  LatticeGroups::make_pattern(const Particles   &particles,
                              const Bonds       &bonds,
                              const unsigned int i)
  {
    std::vector<unsigned int> row;
    find_entries(bonds, i, row);
    const unsigned int n = row.size();
    if (n == 0 || n % 2 != 0)
      return;
    for (unsigned int k = 0; k < n / 2; ++k)
      {
        const unsigned int back = row[k], ahead = row[n - 1 - k];
        const Vector2      X = bonds.offset(particles, i, back);
        const Vector2      Y = bonds.offset(particles, i, ahead);
        x.push_back(0.5 * (Y.x - X.x));
        y.push_back(0.5 * (Y.y - X.y));
        weight.push_back(0.5 * (bonds.weight[back] + bonds.weight[ahead]));
      }
    heaviest = *std::max_element(weight.begin(), weight.end());
    spacing  = particles.spacing;
    for (unsigned int k = 0; k < n; ++k)
      if (!is_pair(bonds.offset(particles, i, row[k]), bonds.weight[row[k]], k))
        {
          x.clear();
          y.clear();
          weight.clear();
          return;
        }
    for (unsigned int t = 0; t < n / 2; ++t)
      {
        weight_x.push_back(weight[t] * x[t]);
        weight_y.push_back(weight[t] * y[t]);
      }
    Symmetric2 moment{0., 0., 0.};
    for (unsigned int t = 0; t < n / 2; ++t)
      {
        moment.xx += 2. * weight_x[t] * x[t];
        moment.yy += 2. * weight_y[t] * y[t];
        moment.xy += 2. * weight_x[t] * y[t];
      }
    shape = inverse(moment);
  }


  unsigned int
  LatticeGroups::pair_of(const Vector2     &offset,
                         const Bonds       &bonds,
                         const unsigned int i,
                         const unsigned int entry) const
  {
    // In a full row the pairs come in the order of the pattern.
    const unsigned int n     = 2 * x.size();
    const unsigned int begin = bonds.list.start[i];
    const unsigned int end   = bonds.list.start[i + 1];
    const double       w     = bonds.weight[entry];
    if (end - begin == n && is_pair(offset, w, entry - begin))
      return entry - begin;
    for (unsigned int k = 0; k < n; ++k)
      if (is_pair(offset, w, k))
        return k;
    return n;
  }


  Vector2
  LatticeGroups::adjusted(const Vector2     &offset,
                          const Bonds       &bonds,
                          const unsigned int i,
                          const unsigned int entry) const
  {
    if (empty())
      return offset;
    const unsigned int n_twos = x.size();
    const unsigned int k      = pair_of(offset, bonds, i, entry);
    if (k >= 2 * n_twos)
      return offset;
    const bool         back = k < n_twos;
    const unsigned int t    = back ? k : 2 * n_twos - 1 - k;
    const double       sign = back ? -1. : 1.;
    return {sign * x[t], sign * y[t]};
  }


  void
  LatticeGroups::adjust_weights(const Particles   &particles,
                                Bonds             &bonds,
                                const unsigned int i) const
  {
    const unsigned int n_twos = x.size();
    for (unsigned int entry = bonds.list.start[i];
         entry < bonds.list.start[i + 1];
         ++entry)
      {
        const unsigned int k =
            pair_of(bonds.offset(particles, i, entry), bonds, i, entry);
        if (k < 2 * n_twos)
          bonds.weight[entry] = weight[k < n_twos ? k : 2 * n_twos - 1 - k];
      }
  }


  void
  LatticeGroups::mark_neighbours(const NeighbourList &list,
                                 const unsigned int   g,
                                 const Use            form)
  {
    use[g] |= form;
    for (unsigned int i = g * group_size;
         i < std::min(n_owned, (g + 1) * group_size);
         ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        if (list.index[k] < n_owned)
          use[list.index[k] / group_size] |= form;
  }


  void
  LatticeGroups::leave(const unsigned int i, const NeighbourList &list)
  {
    const unsigned int g = i / group_size;
    if (use.empty() || !(use[g] & regular))
      return;
    use[g] &= ~regular;
    --n_regular;
    // With pairs at the edge of the support, or with neighbours that are
    // numbered otherwise at the cut to another rank, rows do not stand as the
    // pattern.
    const unsigned int        n_twos = x.size();
    const unsigned int *const two    = &first[2 * g * n_twos];
    bool                      whole  = true;
    for (unsigned int row = g * group_size; row < (g + 1) * group_size; ++row)
      whole = whole && list.start[row + 1] - list.start[row] == 2 * n_twos;
    for (unsigned int t = 0; t < n_twos && whole; ++t)
      {
        const auto row = list.index.begin() + list.start[g * group_size];
        whole =
            row[t] == two[2 * t + 1] && row[2 * n_twos - 1 - t] == two[2 * t];
      }
    if (whole)
      use[g] |= frayed;
    else
      mark_neighbours(list, g, needs_records);
  }


  void
  LatticeGroups::take_motion_of_ghosts(const Particles &particles) const
  {
    if (empty())
      return;
    for (unsigned int i = n_owned; i < particles.n_local; ++i)
      {
        const Motion &m        = particles.motion[i];
        columns[column_u_x][i] = m.u_x;
        columns[column_u_y][i] = m.u_y;
        columns[column_v_x][i] = m.v_x;
        columns[column_v_y][i] = m.v_y;
      }
  }


  void
  LatticeGroups::take_stress_of_ghosts(const Particles &particles) const
  {
    if (empty())
      return;
    for (unsigned int i = n_owned; i < particles.n_local; ++i)
      {
        const PairStress &s   = particles.pair_stress[i];
        columns[column_xx][i] = s.xx;
        columns[column_xy][i] = s.xy;
        columns[column_yx][i] = s.yx;
        columns[column_yy][i] = s.yy;
      }
  }


  void
  LatticeGroups::describe(LatticeArrays &arrays)
  {
    arrays = {};
    if (empty())
      return;
    arrays.n_twos   = x.size();
    arrays.use      = use.data();
    arrays.first    = first.data();
    arrays.x        = x.data();
    arrays.y        = y.data();
    arrays.weight   = weight.data();
    arrays.weight_x = weight_x.data();
    arrays.weight_y = weight_y.data();
    arrays.shape    = shape;
    for (unsigned int k = 0; k < n_lattice_columns; ++k)
      arrays.column[k] = columns[k].data();
  }
} // namespace Morsel::SPH
