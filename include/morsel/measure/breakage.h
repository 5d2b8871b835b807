#ifndef morsel_measure_breakage_h
#define morsel_measure_breakage_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/measure/crack_growth.h>
#include <morsel/measure/fragments.h>
#include <morsel/sph/solid.h>

#include <optional>
#include <vector>

namespace Morsel::Measure
{
  /// What the solid has broken into: the components of its uncut bonds, by
  /// reference positions. Of the whole body on every rank, with labels of the
  /// owned particles; collective.
  /// @param fragment_share the smallest share of the mass that counts [1]
  Fragments
  fragments_of(const SPH::Solid &solid, double fragment_share);


  /// Follows where and when a solid breaks.
  class Breakage
  {
  public:
    struct Failure
    {
      double           time;  ///< [s]
      dealii::Point<2> place; ///< in the reference configuration [m]
    };

    /// The solid, which can fail, is kept by reference.
    /// @param tips of its initial cracks [m]
    explicit Breakage(const SPH::Solid                    &solid,
                      const std::vector<dealii::Point<2>> &tips = {});

    /// Takes in what has failed until now, on all ranks. Does nothing while
    /// nothing fails.
    void
    follow(double time);

    /// The first particle that failed.
    const std::optional<Failure> &
    first_failure() const
    {
      return first;
    }

    /// For each of the tips.
    const std::vector<CrackGrowth> &
    cracks() const
    {
      return growth;
    }

    void
    exchange_state(StateArchive &state);

  private:
    const SPH::Solid        &solid;
    double                   share = 0.; ///< that had failed before [1]
    std::vector<char>        known;      ///< the owned particles that had
    std::optional<Failure>   first;
    std::vector<CrackGrowth> growth;
  };
} // namespace Morsel::Measure

#endif
