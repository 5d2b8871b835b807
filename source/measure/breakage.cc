#include <morsel/core/gather.h>
#include <morsel/measure/breakage.h>
#include <morsel/measure/whole_body.h>

#include <algorithm>

namespace Morsel::Measure
{
  namespace
  {
    struct Place
    {
      unsigned long long id;
      dealii::Point<2>   point; ///< [m]
    };


    /// Where that of the lowest id stood; one rank at least has some.
    dealii::Point<2>
    first_of_all_ranks(const SPH::Solid                &solid,
                       const std::vector<unsigned int> &particles)
    {
      const auto        &p = solid.get_particles();
      std::vector<Place> places;
      for (const unsigned int i : particles)
        places.push_back({p.id[i], p.reference[i]});
      places = gather(places, solid.get_host().communicator());
      return std::min_element(
                 places.begin(),
                 places.end(),
                 [](const Place &a, const Place &b) { return a.id < b.id; })
          ->point;
    }
  } // namespace


  Fragments
  fragments_of(const SPH::Solid &solid, const double fragment_share)
  {
    const auto       &p     = solid.get_particles();
    const auto       &bonds = solid.get_bonds();
    std::vector<char> alive(p.n_owned, 1);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      alive[i] = p.failed.empty() || !p.failed[i];
    alive                = of_whole_body(solid, alive);
    const auto positions = of_whole_body(solid, p.reference);
    const auto areas     = of_whole_body(solid, p.area);
    const auto joined =
        components(solid, [&bonds](const unsigned int, const unsigned int k) {
          return bonds.live.empty() || bonds.live[k] != 0;
        });
    Fragments result = find_fragments(
        alive, joined, positions, areas, p.spacing, fragment_share);
    if (!solid.get_host().is_alone())
      {
        std::vector<int> own;
        for (unsigned int i = 0; i < p.n_owned; ++i)
          own.push_back(result.label[p.id[i]]);
        result.label = own;
      }
    return result;
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
      first = Failure{time, first_of_all_ranks(solid, newly_failed)};
    for (CrackGrowth &crack : growth)
      crack.follow(time, newly_failed);
  }
} // namespace Morsel::Measure
