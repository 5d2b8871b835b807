#ifndef morsel_jaw_drive_h
#define morsel_jaw_drive_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/jaw/muscle.h>
#include <morsel/jaw/prescribed_motion.h>

#include <deal.II/base/mpi.h>

#include <vector>

namespace Morsel::Jaw
{
  /// What moves one plate or several: gives their frame at whole steps. One
  /// that answers the food is told its forces at every step.
  class Drive
  {
  public:
    virtual ~Drive() = default;

    /// The frame at a time [s]: that of the last advance(), where the drive
    /// answers the food.
    virtual Frame
    at(double time) const = 0;

    /// Adds a force of the food on a plate [N] and its moment about the
    /// pivot's present place [N m], of this rank.
    virtual void
    add_load(const dealii::Tensor<1, 2> & /*force*/, double /*moment*/)
    {}

    /// Takes all loads together; once per step.
    /// @param kick from the last half step to the next [s]
    virtual void
    account(double /*kick*/)
    {}

    /// Moves on by a time step [s].
    virtual void
    advance(double /*time_step*/)
    {}

    /// Direction in which a place of the plate moves, or is pushed; 0 if it
    /// stands still.
    virtual dealii::Tensor<1, 2>
    direction(const dealii::Point<2> &place) const = 0;

    /// Nothing for a prescribed motion.
    virtual void
    exchange_state(StateArchive & /*state*/)
    {}
  };


  class PrescribedDrive : public Drive
  {
  public:
    explicit PrescribedDrive(const MotionParameters &parameters)
        : typical_velocity(parameters.typical_velocity())
        , motion(parameters)
    {}

    Frame
    at(const double time) const override
    {
      return motion.at(time);
    }

    dealii::Tensor<1, 2>
    direction(const dealii::Point<2> &) const override
    {
      return typical_velocity;
    }

  private:
    const dealii::Tensor<1, 2> typical_velocity;
    const PrescribedMotion     motion;
  };


  /// A drive with one degree of freedom q and an inertia, moved by an actuator
  /// against the food: m q'' = Q(t, q, q') - c q' + load, by the particles'
  /// leapfrog, with the rate at the whole step predicted from the last
  /// acceleration. The same on all ranks.
  class InertialDrive : public Drive
  {
  public:
    void
    add_load(const dealii::Tensor<1, 2> &force, double moment) override;

    void
    account(double kick) override;

    void
    advance(double time_step) override;

    void
    exchange_state(StateArchive &state) override;

    /// How far it has moved [m or rad], and how fast.
    double
    position() const
    {
      return q;
    }

    double
    rate() const
    {
      return whole_rate;
    }

    /// Of actuator and food at the last account() [N or N m].
    double
    actuator() const
    {
      return action;
    }
    double
    load() const
    {
      return reaction;
    }

    /// What the actuator has done so far [J].
    double
    work() const
    {
      return work_done;
    }

    double
    damped_energy() const
    {
      return damped;
    }

    /// At the last account() [J].
    double
    kinetic_energy() const
    {
      return 0.5 * inertia * whole_rate * whole_rate;
    }

    double
    initial_energy() const
    {
      return first_energy;
    }

    /// Largest step with which its damping is stable [s]; infinite without.
    double
    stable_time_step() const
    {
      return inertia / (damping + actuator_damping());
    }

    /// Mass that a force at a place meets [kg].
    virtual double
    mass_at(const dealii::Point<2> &place) const = 0;

  protected:
    InertialDrive(double   inertia,
                  double   damping,
                  double   initial_rate,
                  double   release,
                  MPI_Comm communicator);

    /// Force or moment of the actuator.
    virtual double
    act(double time, double position, double rate) const = 0;

    /// By which the actuator falls at most with the rate [N s/m or N m s].
    virtual double
    actuator_damping() const
    {
      return 0.;
    }

    /// What a force [N] and a moment [N m] do along q.
    virtual double
    generalised(const dealii::Tensor<1, 2> &force, double moment) const = 0;

    const double   inertia, damping, release;
    const MPI_Comm communicator;

  private:
    double       now = 0., q = 0., half_rate, whole_rate, lag = 0.;
    double       acceleration = 0., action = 0., reaction = 0., to_come = 0.;
    double       accounted_at = 0., drag = 0., work_done = 0., damped = 0.;
    const double first_energy;
  };


  /// A mass on a straight guide under a prescribed force.
  class ForceDrive : public InertialDrive
  {
  public:
    ForceDrive(const MotionParameters &parameters, MPI_Comm communicator);

    Frame
    at(double time) const override;

    dealii::Tensor<1, 2>
    direction(const dealii::Point<2> &) const override
    {
      return along;
    }

    double
    mass_at(const dealii::Point<2> &) const override
    {
      return inertia;
    }

  protected:
    double
    act(double time, double position, double rate) const override;

    double
    generalised(const dealii::Tensor<1, 2> &force, double) const override
    {
      return force * along;
    }

  private:
    const double               size, ramp_time;
    const dealii::Tensor<1, 2> along;
  };


  /// A rigid jaw on a hinge under its muscles, closing with a positive angle.
  class HingeDrive : public InertialDrive
  {
  public:
    HingeDrive(const HingeParameters               &parameters,
               const std::vector<MuscleParameters> &muscles,
               MPI_Comm                             communicator);

    Frame
    at(double time) const override;

    dealii::Tensor<1, 2>
    direction(const dealii::Point<2> &place) const override;

    double
    mass_at(const dealii::Point<2> &place) const override;

  protected:
    double
    act(double time, double angle, double spin) const override;

    double
    actuator_damping() const override;

    double
    generalised(const dealii::Tensor<1, 2> &,
                const double moment) const override
    {
      return moment;
    }

  private:
    const dealii::Point<2> condyle;
    std::vector<Muscle>    muscles;
  };
} // namespace Morsel::Jaw

#endif
