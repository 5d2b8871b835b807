#ifndef morsel_source_drive_record_h
#define morsel_source_drive_record_h

#include "bite.h"

#include <morsel/core/state_archive_fwd.h>
#include <morsel/output/summary.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// Follows plates whose motion is more than a constant velocity, and the
  /// drives that the food slows: nothing in a scene without such plates.
  class DriveRecord
  {
  public:
    explicit DriveRecord(const Bite &bite);

    /// Heads of its columns in the history.
    std::vector<std::string>
    columns() const;

    /// Values of these columns.
    std::vector<double>
    row() const;

    /// Takes the present step in.
    /// @param mean_force of the plates along the closing direction [N]
    void
    follow(double mean_force);

    /// Collective.
    void
    exchange_state(StateArchive &state);

    void
    summarise(Output::Summary &summary) const;

  private:
    /// Speeds along the closing direction, towards the food [m/s].
    struct Speeds
    {
      unsigned int plate;
      double       direction; ///< 1 or -1
      double at_contact = 0., at_peak = 0., slowest = 0., fastest_after = 0.;
    };

    /// Of a drive with inertia [J].
    struct Account
    {
      double work, kinetic, damped, on_food, error;
    };

    double
    speed(const Speeds &speeds) const;

    Account
    account_of(const Jaw::InertialDrive &drive) const;

    void
    summarise_drive(const std::string        &name,
                    const Jaw::InertialDrive &drive,
                    Output::Summary          &summary) const;

    const Bite         &bite;
    std::vector<Speeds> moving;
    bool                touched    = false;
    double              peak_force = 0.;
  };
} // namespace Morsel

#endif
