#include <morsel/jaw/drive.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Jaw
{
  InertialDrive::InertialDrive(const double   inertia,
                               const double   damping,
                               const double   initial_rate,
                               const double   release,
                               const MPI_Comm communicator)
      : inertia(inertia)
      , damping(damping)
      , release(release)
      , communicator(communicator)
      , half_rate(initial_rate)
      , whole_rate(initial_rate)
      , first_energy(0.5 * inertia * initial_rate * initial_rate)
  {}


  void
  InertialDrive::add_load(const dealii::Tensor<1, 2> &force,
                          const double                moment)
  {
    to_come += generalised(force, moment);
  }


  void
  InertialDrive::account(const double kick)
  {
    const double before = action, drag_before = drag;
    reaction = dealii::Utilities::MPI::sum(to_come, communicator);
    to_come  = 0.;
    action   = act(now, q, half_rate + lag * acceleration);
    drag     = damping * (half_rate + lag * acceleration);

    acceleration = now < release ? 0. : (action + reaction - drag) / inertia;
    whole_rate   = half_rate + lag * acceleration;
    half_rate += kick * acceleration;

    const double way = q - accounted_at;
    work_done += 0.5 * (before + action) * way;
    damped += 0.5 * (drag_before + drag) * way;
    accounted_at = q;
  }


  void
  InertialDrive::advance(const double time_step)
  {
    q += time_step * half_rate;
    now += time_step;
    lag        = 0.5 * time_step;
    whole_rate = half_rate + lag * acceleration;
  }


  ForceDrive::ForceDrive(const MotionParameters &parameters,
                         const MPI_Comm          communicator)
      : InertialDrive(parameters.mass, parameters.damping, 0., 0., communicator)
      , size(parameters.force.norm())
      , ramp_time(parameters.ramp_time)
      , along(parameters.force / size)
  {}


  Frame
  ForceDrive::at(const double) const
  {
    Frame frame;
    frame.shift    = position() * along;
    frame.velocity = rate() * along;
    return frame;
  }


  double
  ForceDrive::act(const double time, const double, const double) const
  {
    const double s = std::sin(0.5 * dealii::numbers::PI * time / ramp_time);
    return time < ramp_time ? size * s * s : size;
  }


  HingeDrive::HingeDrive(const HingeParameters               &parameters,
                         const std::vector<MuscleParameters> &muscle_parameters,
                         const MPI_Comm                       communicator)
      : InertialDrive(parameters.inertia,
                      parameters.damping,
                      parameters.first_spin,
                      parameters.release,
                      communicator)
      , condyle(parameters.condyle)
  {
    for (const auto &p : muscle_parameters)
      muscles.emplace_back(p, condyle);
  }


  Frame
  HingeDrive::at(const double) const
  {
    Frame frame;
    frame.pivot = condyle;
    frame.angle = position();
    frame.spin  = rate();
    return frame;
  }


  dealii::Tensor<1, 2>
  HingeDrive::direction(const dealii::Point<2> &place) const
  {
    const auto arm = place - condyle;
    return dealii::Tensor<1, 2>({-arm[1], arm[0]});
  }


  double
  HingeDrive::mass_at(const dealii::Point<2> &place) const
  {
    return inertia / place.distance_square(condyle);
  }


  double
  HingeDrive::actuator_damping() const
  {
    double sum = 0.;
    for (const auto &muscle : muscles)
      sum += muscle.largest_damping();
    return sum;
  }


  double
  HingeDrive::act(const double time,
                  const double angle,
                  const double spin) const
  {
    double moment = 0.;
    for (const auto &muscle : muscles)
      moment += muscle.at(time, angle, spin).moment;
    return moment;
  }
} // namespace Morsel::Jaw
