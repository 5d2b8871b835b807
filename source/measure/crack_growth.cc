#include <morsel/measure/crack_growth.h>
#include <morsel/measure/disjoint_sets.h>
#include <morsel/measure/whole_body.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Measure
{
  namespace
  {
    /// A crack begins in what fails this near to its tip, in spacings.
    constexpr double reach_of_tip = 3.;

    /// Speeds are means over an advance of so many spacings: a crack goes
    /// from particle to particle.
    constexpr double stretch = 10.;

    /// Branches are counted beyond this share of the extension.
    constexpr double far = 0.75;


    /// Those of particle @p i in the reference configuration, cut or not.
    template <typename Function>
    void
    for_neighbours(const SPH::Solid  &solid,
                   const unsigned int i,
                   const Function    &function)
    {
      const auto &list = solid.get_bonds().list;
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        function(list.index[k]);
    }
  } // namespace


  double
  rayleigh_speed(const Materials::Elasticity &m)
  {
    // With x = v^2/cs^2; the root at x = 0 is left out by beginning above it.
    const double ratio = m.mu / m.p_wave_modulus;
    const auto   f     = [ratio](const double x) {
      return (2. - x) * (2. - x) -
             4. * std::sqrt(1. - ratio * x) * std::sqrt(1. - x);
    };
    double a = 0.1, b = 1.;
    for (int k = 0; k < 60; ++k)
      {
        const double x      = 0.5 * (a + b);
        (f(x) < 0. ? a : b) = x;
      }
    return std::sqrt(0.5 * (a + b) * m.mu / m.density);
  }


  CrackGrowth::CrackGrowth(const SPH::Solid &solid, const dealii::Point<2> &tip)
      : solid(solid)
      , tip(tip)
      , is_crack(solid.get_particles().n_local, 0)
  {}


  bool
  CrackGrowth::touches(const unsigned int i) const
  {
    const auto &p = solid.get_particles();
    if (p.reference[i].distance(tip) < reach_of_tip * p.spacing)
      return true;
    bool found = false;
    for_neighbours(
        solid, i, [&](const unsigned int j) { found = found || is_crack[j]; });
    return found;
  }


  bool
  CrackGrowth::take_in(const std::vector<unsigned int> &candidates,
                       double                          &farthest)
  {
    const auto               &p   = solid.get_particles();
    bool                      any = false;
    std::vector<unsigned int> front;
    for (const unsigned int first : candidates)
      {
        if (is_crack[first] || !touches(first))
          continue;
        is_crack[first] = 1;
        any             = true;
        front.push_back(first);
        // What failed apart from the crack may be joined to it now.
        while (!front.empty())
          {
            const unsigned int i = front.back();
            front.pop_back();
            farthest = std::max(farthest, p.reference[i].distance(tip));
            for_neighbours(solid, i, [&](const unsigned int j) {
              if (j < p.n_owned && p.failed[j] && !is_crack[j])
                {
                  is_crack[j] = 1;
                  front.push_back(j);
                }
            });
          }
      }
    return any;
  }


  void
  CrackGrowth::follow(const double                     time,
                      const std::vector<unsigned int> &newly_failed)
  {
    const auto &host     = solid.get_host();
    double      farthest = extension();
    bool        any      = take_in(newly_failed, farthest);
    if (!host.is_alone())
      {
        // On from what other ranks have found, until none finds any more.
        const auto               &p = solid.get_particles();
        std::vector<unsigned int> at_boundary;
        for (unsigned int i = 0; i < host.n_boundary(); ++i)
          if (p.failed[i])
            at_boundary.push_back(i);
        while (host.maximum(any) > 0.)
          {
            host.exchange(is_crack);
            any = take_in(at_boundary, farthest);
          }
        farthest = host.maximum(farthest);
      }
    if (!(farthest > extension()))
      return;
    course.push_back({time, farthest});
    fastest = std::max(fastest, speed(time));
  }


  std::optional<double>
  CrackGrowth::start() const
  {
    return course.empty() ? std::nullopt
                          : std::optional<double>(course.front().time);
  }


  double
  CrackGrowth::speed(const double time) const
  {
    const double begin = extension() - stretch * solid.get_particles().spacing;
    const auto   after = std::upper_bound(
        course.begin(),
        course.end(),
        begin,
        [](const double x, const Advance &a) { return x < a.extension; });
    if (after == course.begin())
      return 0.;
    const Advance &from = *(after - 1);
    return time > from.time
               ? (extension() - from.extension) / (time - from.time)
               : 0.;
  }


  unsigned int
  CrackGrowth::branch_count() const
  {
    const auto  &p      = solid.get_particles();
    const double radius = far * extension();
    const auto   beyond = [&](const unsigned int i) {
      return is_crack[i] && p.reference[i].distance(tip) > radius;
    };
    const auto &pairs = solid.get_bonds().list.index;
    const auto  joined =
        components(solid, [&](const unsigned int i, const unsigned int k) {
          return beyond(i) && beyond(pairs[k]);
        });
    std::vector<char> counts(p.n_owned);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      counts[i] = beyond(i);
    counts = of_whole_body(solid, counts);

    DisjointSets sets(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
      for (auto k = joined.first[i]; k < joined.first[i + 1]; ++k)
        sets.join(i, joined.neighbour[k]);
    unsigned int count = 0;
    for (std::size_t i = 0; i < counts.size(); ++i)
      count += counts[i] && sets.root(i) == i;
    return count;
  }
} // namespace Morsel::Measure
