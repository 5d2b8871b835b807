#include <morsel/jaw/plate.h>

namespace Morsel::Jaw
{
  namespace
  {
    std::vector<std::vector<dealii::Point<2>>>
    loops_of(const Scene::Outline &outline)
    {
      const auto                                &edges  = outline.get_edges();
      const auto                                &starts = outline.loop_starts();
      std::vector<std::vector<dealii::Point<2>>> loops(starts.size() - 1);
      for (unsigned int l = 0; l < loops.size(); ++l)
        for (unsigned int e = starts[l]; e < starts[l + 1]; ++e)
          loops[l].push_back(edges[e].first);
      return loops;
    }
  } // namespace


  Plate::Plate(const Scene::PlateBody &body,
               std::shared_ptr<Drive>  drive,
               const double            node_spacing)
      : body(body)
      , surface(Contact::polygon_surface(body.name,
                                         loops_of(body.shape.outline()),
                                         node_spacing))
      , drive(std::move(drive))
      , initial_nodes(surface.nodes)
  {}


  Plate::Plate(const Scene::PlateBody &body,
               std::shared_ptr<Drive>  drive,
               const FE::ElasticBody  &mesh)
      : body(body)
      , surface(Contact::polyline_surface(body.name,
                                          mesh.surface_nodes(),
                                          mesh.surface_facets()))
      , drive(std::move(drive))
      , initial_nodes(surface.nodes)
  {}


  void
  Plate::set_deformation(std::unique_ptr<Deformation> given)
  {
    deformation        = std::move(given);
    half_step_velocity = drive->at(0.).velocity;
  }


  void
  Plate::move_to(const double time)
  {
    now          = time;
    placed       = drive->at(time);
    const auto R = placed.orientation();
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      {
        surface.nodes[k]    = placed.place(initial_nodes[k], R);
        surface.velocity[k] = placed.velocity_at(surface.nodes[k]);
        surface.force[k]    = 0.;
      }
    if (deformation)
      {
        deformation->turn(R);
        deformation->add_to(surface);
      }
  }


  bool
  Plate::settle(const std::vector<const Contact::Touches *> &touches,
                const double                                 time_step)
  {
    if (deformation->settle(surface, touches, time_step))
      return true;
    for (auto &f : surface.force)
      f = 0.;
    return false;
  }


  void
  Plate::account(const double kick, const double time_step)
  {
    load                     = surface.total_force();
    const auto   before      = push;
    const double moment_then = push_moment;
    push                     = -load;
    // Prescribed shifts need no moment, and the sum takes time.
    const bool turns =
        placed.angle != 0. || placed.spin != 0. || !body.motion.is_prescribed();
    if (turns)
      {
        const auto pivot = placed.pivot + placed.shift;
        push_moment      = 0.;
        for (unsigned int k = 0; k < surface.nodes.size(); ++k)
          push_moment -= cross(surface.nodes[k] - pivot, surface.force[k]);
        drive->add_load(load, -push_moment);
      }
    if (deformation)
      {
        const auto next =
            body.motion.is_prescribed()
                ? (drive->at(now + time_step).shift - placed.shift) / time_step
                : placed.velocity;
        push = deformation->account(surface, {kick, half_step_velocity, next});
        half_step_velocity = next;
      }
    work_done +=
        0.5 * (before + push) * (placed.shift - accounted_at.shift) +
        0.5 * (moment_then + push_moment) * (placed.angle - accounted_at.angle);
    impulse_given += impulse_to_come;
    impulse_to_come = push * kick;
    accounted_at    = placed;
  }


  namespace
  {
    dealii::Point<2>
    middle(const Scene::Rectangle &box)
    {
      return box.lower_corner + 0.5 * (box.upper_corner - box.lower_corner);
    }
  } // namespace


  dealii::Tensor<1, 2>
  Plate::displacement() const
  {
    return placed.angle == 0.
               ? placed.shift
               : placed.place(middle(body.shape)) - middle(body.shape);
  }


  dealii::Tensor<1, 2>
  Plate::velocity() const
  {
    return placed.velocity_at(placed.place(middle(body.shape)));
  }
} // namespace Morsel::Jaw
