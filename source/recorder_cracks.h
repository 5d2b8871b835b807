#ifndef morsel_source_recorder_cracks_h
#define morsel_source_recorder_cracks_h

#include "bite.h"

#include <morsel/core/log.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/fracture/hoop_stress.h>
#include <morsel/output/summary.h>

#include <optional>
#include <string>
#include <vector>

namespace Morsel
{
  /// Follows the cracks of elastic plates: K_I and K_II of every tip, whether
  /// its crack would grow, and whether faces would overlap.
  class ToothCrackRecorder
  {
  public:
    explicit ToothCrackRecorder(const Bite &bite, RunLog &log);

    /// Of the history: K_I and K_II by tip, then the opening by body.
    std::vector<std::string>
    columns() const;

    /// Takes a moment in.
    /// @param forces normal ones, by plate [N]
    /// @return a value for each column
    std::vector<double>
    follow(const std::vector<double> &forces);

    void
    exchange_state(StateArchive &state);

    void
    summarise(Output::Summary &summary) const;

  private:
    struct Moment
    {
      double time  = 0.; ///< [s]
      double force = 0.; ///< normal, on the plate [N]
      double K     = 0.; ///< what is remembered of it [Pa sqrt(m)]
      double angle = 0.; ///< of growth [rad]
    };

    struct Tip
    {
      std::string           suffix;         ///< "_tooth", "_tooth_tip1", ...
      double                toughness = 0.; ///< [Pa sqrt(m)]
      Moment                largest_I, largest_II, largest;
      double                smallest_I = 0., largest_spread = 0.;
      std::optional<Moment> growth; ///< first reached
    };

    struct Body
    {
      unsigned int     plate;
      std::string      name;
      std::vector<Tip> tips;
      double           smallest_opening = 0., largest_opening = 0.; ///< [m]
      double           force_at_smallest = 0.;                      ///< [N]
    };

    void
    follow_tip(Tip &tip, const Fracture::RingStatistics &K, double force) const;

    void
    summarise_tip(Output::Summary &summary, const Tip &tip) const;

    const Bite       &bite;
    RunLog           &log;
    std::vector<Body> bodies;
  };
} // namespace Morsel

#endif
