#ifndef morsel_sph_local_numbers_h
#define morsel_sph_local_numbers_h

#include <algorithm>
#include <utility>
#include <vector>

namespace Morsel::SPH
{
  /// Where a particle that goes by its id stands in this rank's arrays.
  class LocalNumbers
  {
  public:
    LocalNumbers() = default;

    /// @param ids of all particles that the rank knows
    explicit LocalNumbers(const std::vector<unsigned long long> &ids)
    {
      for (unsigned int i = 0; i < ids.size(); ++i)
        places.emplace_back(ids[i], i);
      std::sort(places.begin(), places.end());
    }

    /// -1 where the rank does not know the particle.
    long
    find(const unsigned long long id) const
    {
      const auto place = std::lower_bound(
          places.begin(), places.end(), std::make_pair(id, 0u));
      return place != places.end() && place->first == id
                 ? static_cast<long>(place->second)
                 : -1;
    }

  private:
    std::vector<std::pair<unsigned long long, unsigned int>> places;
  };
} // namespace Morsel::SPH

#endif
