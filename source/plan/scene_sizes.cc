#include <morsel/fracture_run.h>
#include <morsel/plan/scene_sizes.h>
#include <morsel/scene/read.h>

#include <algorithm>

namespace Morsel::Plan
{
  namespace
  {
    /// See sizes_of_plate().
    double
    crack_scale(const Fracture::PlateScene         &plate,
                const std::vector<Fracture::Crack> &cracks,
                const Fracture::CrackTip           &tip)
    {
      const Fracture::Crack &crack    = cracks[tip.crack];
      const bool             two_tips = crack.has_tip(0) && crack.has_tip(1) &&
                            crack.get_vertices().size() == 2;
      double scale = std::min(tip.segment * (two_tips ? 0.5 : 1.),
                              Fracture::depth_inside(plate, tip.position));
      for (unsigned int c = 0; c < cracks.size(); ++c)
        if (c != tip.crack)
          scale = std::min(scale, 0.5 * cracks[c].distance(tip.position));
      return scale;
    }
  } // namespace


  SceneSizes
  sizes_of_plate(const Fracture::PlateScene &plate)
  {
    SceneSizes   sizes;
    const auto   size    = plate.upper_corner - plate.lower_corner;
    const double shorter = std::min(size[0], size[1]);
    const auto   cracks  = Fracture::make_cracks(plate);
    const auto   tips    = Fracture::collect_tips(cracks);
    sizes.name           = plate.name;
    if (tips.empty())
      sizes.obstacle = "it has no crack tip";
    else
      sizes.kind = "cracked plate";
    double length = 0.1 * shorter;
    for (const Fracture::CrackTip &tip : tips)
      length = std::min(length, crack_scale(plate, cracks, tip));
    sizes.scene = {{"width", size[0]},
                   {"height", size[1]},
                   {"shorter", shorter},
                   {"length", length}};
    return sizes;
  }


  SceneSizes
  sizes_of_bodies(const Scene::Scene &scene)
  {
    SceneSizes sizes;
    sizes.name = scene.name;
    sizes.kind = !scene.plate_bodies.empty() ? "stroke"
                 : scene.time.is_static()    ? "static body"
                                             : "body in motion";
    for (const Scene::ParticleBody &body : scene.particle_bodies)
      {
        const Scene::Outline outline   = body.shape.outline();
        double               perimeter = 0.;
        for (const Scene::Outline::Edge &edge : outline.get_edges())
          perimeter += edge.length();
        sizes.bodies.push_back(
            {body.name,
             {{"width", body.shape.extent(0)},
              {"thickness", 2. * body.shape.area() / perimeter}}});
        if (!body.cracks.paths.empty())
          sizes.obstacle = "body '" + body.name + "' has cracks";
        if (body.solid.is_updated())
          sizes.obstacle = "body '" + body.name + "' is updated Lagrangian";
      }
    if (!sizes.obstacle.empty())
      sizes.kind.clear();
    return sizes;
  }


  SceneSizes
  read_sizes(const std::string              &scene_file,
             const std::vector<std::string> &overrides)
  {
    return is_fracture_scene(scene_file, overrides)
               ? sizes_of_plate(read_plate_scene(scene_file, overrides))
               : sizes_of_bodies(Scene::read_scene(scene_file, overrides));
  }
} // namespace Morsel::Plan
