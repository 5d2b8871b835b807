#ifndef morsel_measure_whole_body_h
#define morsel_measure_whole_body_h

#include <morsel/core/gather.h>
#include <morsel/measure/fragments.h>
#include <morsel/sph/solid.h>

#include <functional>
#include <type_traits>
#include <vector>

namespace Morsel::Measure
{
  /// A value of each particle of a body on all ranks, in the order of their
  /// ids, from those of the particles that each rank knows, the owned ones
  /// first. Collective; on one rank a copy.
  template <typename Value>
  std::vector<Value>
  of_whole_body(const SPH::ParticleHost<2> &host,
                const std::vector<Value>   &values)
  {
    const unsigned int n   = host.n_owned();
    const auto         own = [n](const auto &all) {
      return std::vector<typename std::decay_t<decltype(all)>::value_type>(
          all.begin(), all.begin() + n);
    };
    const auto gathered = gather(own(values), host.communicator());
    if (host.is_alone())
      return gathered;
    const auto         ids = gather(own(host.ids()), host.communicator());
    std::vector<Value> result(gathered.size());
    for (std::size_t k = 0; k < ids.size(); ++k)
      result[ids[k]] = gathered[k];
    return result;
  }

  template <typename Value>
  std::vector<Value>
  of_whole_body(const SPH::Solid &solid, const std::vector<Value> &values)
  {
    return of_whole_body(solid.get_host(), values);
  }


  /// What hangs together over those of a body's pairs that hold, on all ranks
  /// and in the order of ids: on one rank the pairs themselves, else fewer that
  /// have the same components. Collective.
  /// @param holds whether entry k of the pairs of particle i, owned, does
  BondList
  components(const SPH::Solid                                          &solid,
             const std::function<bool(unsigned int i, unsigned int k)> &holds);
} // namespace Morsel::Measure

#endif
