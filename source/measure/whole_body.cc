#include <morsel/measure/disjoint_sets.h>
#include <morsel/measure/whole_body.h>

#include <array>

namespace Morsel::Measure
{
  namespace
  {
    using Link = std::array<unsigned long long, 2>;


    /// Rows of links, each in that of its first id.
    BondList
    in_rows(const std::vector<Link> &links, const std::size_t n)
    {
      BondList list;
      list.first.assign(n + 1, 0);
      for (const Link &link : links)
        ++list.first[link[0] + 1];
      std::partial_sum(
          list.first.begin(), list.first.end(), list.first.begin());
      list.neighbour.resize(links.size());
      auto next = list.first;
      for (const Link &link : links)
        list.neighbour[next[link[0]]++] = link[1];
      return list;
    }
  } // namespace


  BondList
  components(const SPH::Solid                                          &solid,
             const std::function<bool(unsigned int i, unsigned int k)> &holds)
  {
    const auto &p     = solid.get_particles();
    const auto &pairs = solid.get_bonds().list;
    const auto &host  = solid.get_host();
    if (host.is_alone())
      {
        BondList list;
        list.first.push_back(0);
        for (unsigned int i = 0; i < p.n_owned; ++i)
          {
            for (unsigned int k = pairs.start[i]; k < pairs.start[i + 1]; ++k)
              if (holds(i, k))
                list.neighbour.push_back(pairs.index[k]);
            list.first.push_back(list.neighbour.size());
          }
        return list;
      }

    // Each rank says of what it knows to which of these it belongs; the ghosts
    // join what several ranks say.
    DisjointSets sets(p.n_local);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      for (unsigned int k = pairs.start[i]; k < pairs.start[i + 1]; ++k)
        if (holds(i, k))
          sets.join(i, pairs.index[k]);
    std::vector<Link> links;
    for (unsigned int i = 0; i < p.n_local; ++i)
      if (sets.root(i) != i)
        links.push_back({{p.id[i], p.id[sets.root(i)]}});
    return in_rows(gather(links, host.communicator()), host.n_global());
  }
} // namespace Morsel::Measure
