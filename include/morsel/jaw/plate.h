#ifndef morsel_jaw_plate_h
#define morsel_jaw_plate_h

#include <morsel/contact/surface.h>
#include <morsel/jaw/deformation.h>
#include <morsel/jaw/drive.h>
#include <morsel/scene/scene.h>

#include <memory>

namespace Morsel::Jaw
{
  /// A body with a surface that moves with its drive, rigid or with a
  /// deformation of its own, and the account of what moving it costs.
  class Plate
  {
  public:
    /// A rigid rectangle or mesh.
    /// @param node_spacing of the surface, at most [m].
    Plate(const Scene::PlateBody &body,
          std::shared_ptr<Drive>  drive,
          double                  node_spacing);

    /// With the surface of a mesh, rigid as long as no deformation is given.
    Plate(const Scene::PlateBody &body,
          std::shared_ptr<Drive>  drive,
          const FE::ElasticBody  &mesh);

    void
    set_deformation(std::unique_ptr<Deformation> deformation);

    /// Null for a rigid one.
    const Deformation *
    get_deformation() const
    {
      return deformation.get();
    }

    /// Puts the surface where it is at a time [s] and clears its forces.
    void
    move_to(double time);

    /// Whether its shape depends on the contact forces of the same moment.
    bool
    settles() const
    {
      return deformation && deformation->settles();
    }

    /// See Deformation::settle(). If it says no, contact has to be computed
    /// anew on the surface, whose forces are cleared.
    bool
    settle(const std::vector<const Contact::Touches *> &touches,
           double                                       time_step);

    /// Takes the forces on the surface into account: work done by the drive
    /// since the last call (trapezoidal rule) and impulse given by it over
    /// @p kick seconds. Call it once per step after contact.
    /// @param time_step that follows [s]
    void
    account(double kick, double time_step);

    /// The steps from now on [s]; before account().
    void
    change_time_step(const double time_step)
    {
      if (deformation)
        deformation->change_time_step(time_step);
    }

    /// Moves the deformation on.
    void
    advance(const double time_step)
    {
      if (deformation)
        deformation->advance(time_step);
    }

    /// Of the body as a whole, without what it deforms.
    const Frame &
    frame() const
    {
      return placed;
    }

    /// Of the middle of its box [m], [m/s].
    dealii::Tensor<1, 2>
    displacement() const;

    dealii::Tensor<1, 2>
    velocity() const;

    const std::shared_ptr<Drive> &
    get_drive() const
    {
      return drive;
    }

    /// Force of the food on the plate at the last account() [N].
    const dealii::Tensor<1, 2> &
    force() const
    {
      return load;
    }

    /// Work that the drive has done on the food and the plate's deformation
    /// [J].
    double
    work() const
    {
      return work_done;
    }

    /// Impulse that the drive has given to them up to the last half step
    /// at which the food's velocities stand [N s].
    const dealii::Tensor<1, 2> &
    impulse() const
    {
      return impulse_given;
    }

    void
    exchange_state(StateArchive &state);

    const Scene::PlateBody &body;
    Contact::Surface        surface;

  private:
    std::shared_ptr<Drive>        drive;
    std::unique_ptr<Deformation>  deformation;
    std::vector<dealii::Point<2>> initial_nodes;
    double                        now = 0.;
    Frame                         placed, accounted_at;
    dealii::Tensor<1, 2>          load, push, impulse_given, impulse_to_come,
        half_step_velocity;
    double push_moment = 0.; ///< about the pivot [N m]
    double work_done   = 0.;
  };
} // namespace Morsel::Jaw

#endif
