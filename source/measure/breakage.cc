#include <morsel/measure/breakage.h>

namespace Morsel::Measure
{
  Fragments
  fragments_of(const SPH::Solid &solid, const double fragment_share)
  {
    const auto               &p     = solid.get_particles();
    const auto               &bonds = solid.get_bonds();
    std::vector<char>         alive(p.n_owned, 1);
    const std::vector<double> areas(p.area.begin(), p.area.begin() + p.n_owned);
    BondList                  friends;
    friends.first.push_back(0);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        alive[i] = p.failed.empty() || !p.failed[i];
        for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
             ++k)
          if (bonds.list.index[k] < p.n_owned && bonds.live[k])
            friends.neighbour.push_back(bonds.list.index[k]);
        friends.first.push_back(friends.neighbour.size());
      }
    return find_fragments(alive,
                          friends,
                          dealii::ArrayView<const dealii::Point<2>>(
                              p.reference.data(), p.n_owned),
                          areas,
                          p.spacing,
                          fragment_share);
  }


  Breakage::Breakage(const SPH::Solid                    &solid,
                     const std::vector<dealii::Point<2>> &tips)
      : solid(solid)
      , known(solid.get_particles().n_owned, 0)
  {
    for (const auto &tip : tips)
      growth.emplace_back(solid, tip);
  }


  void
  Breakage::follow(const double time)
  {
    if (!(solid.failed_share() > share))
      return;
    share                       = solid.failed_share();
    const auto               &p = solid.get_particles();
    std::vector<unsigned int> newly_failed;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      if (p.failed[i] && !known[i])
        {
          known[i] = 1;
          newly_failed.push_back(i);
        }
    if (!first)
      first = Failure{time, p.reference[newly_failed.front()]};
    for (CrackGrowth &crack : growth)
      crack.follow(time, newly_failed);
  }
} // namespace Morsel::Measure
