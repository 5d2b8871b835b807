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


  Plate::Plate(const Scene::PlateBody &body, const double node_spacing)
      : body(body)
      , surface(Contact::polygon_surface(body.name,
                                         loops_of(body.shape.outline()),
                                         node_spacing))
      , initial_nodes(surface.nodes)
  {}


  Plate::Plate(const Scene::PlateBody &body, const FE::ElasticBody &mesh)
      : body(body)
      , surface(Contact::polyline_surface(body.name,
                                          mesh.surface_nodes(),
                                          mesh.surface_facets()))
      , initial_nodes(surface.nodes)
  {}


  void
  Plate::set_deformation(std::unique_ptr<Deformation> given)
  {
    deformation        = std::move(given);
    half_step_velocity = velocity_at(body.motion, 0.);
  }


  void
  Plate::move_to(const double time)
  {
    now   = time;
    moved = displacement_at(body.motion, time);
    speed = velocity_at(body.motion, time);
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      {
        surface.nodes[k]    = initial_nodes[k] + moved;
        surface.velocity[k] = speed;
        surface.force[k]    = 0.;
      }
    if (deformation)
      deformation->add_to(surface);
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
    load              = surface.total_force();
    const auto before = push;
    push              = -load;
    if (deformation)
      {
        const auto next =
            (displacement_at(body.motion, now + time_step) - moved) / time_step;
        push = deformation->account(surface, {kick, half_step_velocity, next});
        half_step_velocity = next;
      }
    work_done += 0.5 * (before + push) * (moved - accounted_at);
    impulse_given += impulse_to_come;
    impulse_to_come = push * kick;
    accounted_at    = moved;
  }
} // namespace Morsel::Jaw
