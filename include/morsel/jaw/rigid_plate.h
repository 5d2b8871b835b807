#ifndef morsel_jaw_rigid_plate_h
#define morsel_jaw_rigid_plate_h

#include <morsel/contact/surface.h>
#include <morsel/scene/scene.h>

namespace Morsel::Jaw
{
  /// A rigid body with a surface that moves as prescribed, and the account of
  /// what moving it costs.
  class RigidPlate
  {
  public:
    /// @param node_spacing of the surface [m].
    RigidPlate(const Scene::RigidBody &body, double node_spacing);

    /// Puts the surface where it is at a time [s] and clears its forces.
    void
    move_to(double time);

    /// Takes the forces on the surface into account: work done on the food
    /// since the last call (trapezoidal rule) and impulse given to it over
    /// @p kick seconds. Call it once per step after contact.
    void
    account(double kick);

    const dealii::Tensor<1, 2> &
    displacement() const
    {
      return moved;
    }

    const dealii::Tensor<1, 2> &
    velocity() const
    {
      return speed;
    }

    /// Force of the food on the plate at the last account() [N].
    const dealii::Tensor<1, 2> &
    force() const
    {
      return load;
    }

    /// Work that the plate has done on the food [J].
    double
    work() const
    {
      return work_done;
    }

    /// Impulse that the plate has given to the food up to the last half step
    /// at which the food's velocities stand [N s].
    const dealii::Tensor<1, 2> &
    impulse() const
    {
      return impulse_given;
    }

    const Scene::RigidBody &body;
    Contact::Surface        surface;

  private:
    std::vector<dealii::Point<2>> initial_nodes;
    dealii::Tensor<1, 2> moved, speed, load, impulse_given, impulse_to_come,
        accounted_at;
    double work_done = 0.;
  };
} // namespace Morsel::Jaw

#endif
