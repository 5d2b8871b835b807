#include "drive_record.h"
#include "run_summary.h"

#include <algorithm>
#include <cmath>

namespace Morsel
{
  DriveRecord::DriveRecord(const Bite &bite)
      : bite(bite)
  {
    const auto &plates = bite.get_plates();
    for (unsigned int p = 0; p < plates.size(); ++p)
      if (plates[p].body.motion.kind != "constant")
        moving.push_back({p, bite.towards_food(p)});
  }


  double
  DriveRecord::speed(const Speeds &speeds) const
  {
    return speeds.direction *
           bite.get_plates()[speeds.plate].velocity()[bite.closing_axis()];
  }


  std::vector<std::string>
  DriveRecord::columns() const
  {
    std::vector<std::string> heads;
    for (const auto &one : moving)
      {
        const std::string name =
            underscored(bite.get_plates()[one.plate].body.name);
        heads.insert(heads.end(),
                     {"displacement_x_" + name + " [m]",
                      "displacement_y_" + name + " [m]",
                      "closing_speed_" + name + " [m/s]"});
      }
    for (const auto &[name, drive] : bite.inertial_drives())
      {
        const bool        jaw  = name == "jaw";
        const std::string what = underscored(name);
        heads.insert(
            heads.end(),
            {what + (jaw ? "_angle [rad]" : "_way [m]"),
             what + (jaw ? "_spin [rad/s]" : "_speed [m/s]"),
             jaw ? "muscle_moment [N m]" : "driving_force_" + what + " [N]",
             jaw ? "muscle_work [J]" : "driving_work_" + what + " [J]",
             what + "_kinetic_energy [J]"});
      }
    return heads;
  }


  std::vector<double>
  DriveRecord::row() const
  {
    std::vector<double> values;
    for (const auto &one : moving)
      {
        const auto shift = bite.get_plates()[one.plate].displacement();
        values.insert(values.end(), {shift[0], shift[1], speed(one)});
      }
    for (const auto &[name, drive] : bite.inertial_drives())
      values.insert(values.end(),
                    {drive->position(),
                     drive->rate(),
                     drive->actuator(),
                     drive->work(),
                     drive->kinetic_energy()});
    return values;
  }


  void
  DriveRecord::follow(const double mean_force)
  {
    if (moving.empty())
      return;
    const bool contact = mean_force > 0.;
    for (auto &one : moving)
      {
        const double v = speed(one);
        if (contact && !touched)
          one.at_contact = one.slowest = v;
        if (mean_force > peak_force)
          {
            one.at_peak       = v;
            one.fastest_after = v;
            one.slowest       = std::min(one.slowest, v);
          }
        one.fastest_after = std::max(one.fastest_after, v);
      }
    touched    = touched || contact;
    peak_force = std::max(peak_force, mean_force);
  }


  DriveRecord::Account
  DriveRecord::account_of(const Jaw::InertialDrive &drive) const
  {
    Account      a{drive.work(),
              drive.kinetic_energy(),
              drive.damped_energy(),
              bite.work_on_food(drive),
              0.};
    const double gap =
        a.work + drive.initial_energy() - a.kinetic - a.damped - a.on_food;
    const double largest = std::max({std::abs(a.work),
                                     drive.initial_energy(),
                                     a.kinetic,
                                     std::abs(a.damped),
                                     std::abs(a.on_food)});
    a.error              = largest > 0. ? std::abs(gap) / largest : 0.;
    return a;
  }


  void
  DriveRecord::summarise_drive(const std::string        &name,
                               const Jaw::InertialDrive &drive,
                               Output::Summary          &summary) const
  {
    const bool        jaw  = name == "jaw";
    const std::string what = underscored(name);
    const Account     a    = account_of(drive);
    summary.add(jaw ? "muscle_work" : "driving_work_" + what,
                a.work,
                "J",
                jaw ? "done by the muscles on the jaw"
                    : "done by the force on the " + name);
    summary.add(what + "_work_on_food",
                a.on_food,
                "J",
                "of this passed on to the food and to what deforms");
    summary.add(
        what + "_kinetic_energy", a.kinetic, "J", "of its inertia, at the end");
    summary.add(what + "_damped_energy", a.damped, "J", "lost in its damping");
    summary.add(what + "_energy_error",
                a.error,
                "1",
                "closing error of these over the largest");
  }


  void
  DriveRecord::summarise(Output::Summary &summary) const
  {
    for (const auto &one : moving)
      {
        const std::string &plate = bite.get_plates()[one.plate].body.name;
        const std::string  name  = underscored(plate);
        summary.add("closing_speed_at_contact_" + name,
                    one.at_contact,
                    "m/s",
                    "of the " + plate + " when the food was first pressed");
        summary.add("closing_speed_at_peak_" + name,
                    one.at_peak,
                    "m/s",
                    "at the peak of the force");
        summary.add("slowest_closing_speed_" + name,
                    one.slowest,
                    "m/s",
                    "from the first contact to the peak of the force");
        summary.add("fastest_closing_speed_after_peak_" + name,
                    one.fastest_after,
                    "m/s",
                    "after the peak of the force");
      }
    for (const auto &[name, drive] : bite.inertial_drives())
      summarise_drive(name, *drive, summary);
  }
} // namespace Morsel
