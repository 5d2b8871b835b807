#include <morsel/jaw/rigid_plate.h>

namespace Morsel::Jaw
{
  RigidPlate::RigidPlate(const Scene::RigidBody &body,
                         const double            node_spacing)
      : body(body)
      , surface(Contact::rectangle_surface(body.name,
                                           body.shape.lower_corner,
                                           body.shape.upper_corner,
                                           node_spacing))
      , initial_nodes(surface.nodes)
  {}


  void
  RigidPlate::move_to(const double time)
  {
    moved = displacement_at(body.motion, time);
    speed = velocity_at(body.motion, time);
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      {
        surface.nodes[k]    = initial_nodes[k] + moved;
        surface.velocity[k] = speed;
        surface.force[k]    = 0.;
      }
  }


  void
  RigidPlate::account(const double kick)
  {
    const auto before = load;
    load              = surface.total_force();
    work_done -= 0.5 * (before + load) * (moved - accounted_at);
    impulse_given += impulse_to_come;
    impulse_to_come = -load * kick;
    accounted_at    = moved;
  }
} // namespace Morsel::Jaw
