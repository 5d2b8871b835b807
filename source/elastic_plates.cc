#include "elastic_plates.h"

#include "tooth_cracks.h"

#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fe/plate_mesh.h>
#include <morsel/scene/mesh.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel
{
  namespace
  {
    /// A body that answers within this share of the loading has no inertia.
    constexpr double quick_answer = 0.1;

    /// Cells closer to a crack tip than so many of their diameters are halved.
    constexpr double refined_layers = 2.;


    std::set<dealii::types::boundary_id>
    held_ids(const Scene::PlateBody &plate)
    {
      std::map<std::string, unsigned int> ids = {
          {"left", FE::PlateSide::left},
          {"right", FE::PlateSide::right},
          {"bottom", FE::PlateSide::bottom},
          {"top", FE::PlateSide::top}};
      if (plate.shape.is_mesh())
        ids = Scene::sides_of_mesh(plate.shape.mesh_file);
      std::set<dealii::types::boundary_id> held;
      for (const auto &name : dealii::Utilities::split_string_list(
               plate.deformation.held_sides, ','))
        held.insert(ids.at(name));
      return held;
    }


    /// The axis that the surface faces where it is nearest to the food.
    unsigned int
    axis_towards(const Scene::Rectangle &food, const FE::ElasticBody &body)
    {
      const auto          &nodes = body.surface_nodes();
      double               least = std::numeric_limits<double>::infinity();
      dealii::Tensor<1, 2> along;
      for (const auto &[first, second] : body.surface_facets())
        {
          const dealii::Point<2> x =
              nodes[first] + 0.5 * (nodes[second] - nodes[first]);
          dealii::Tensor<1, 2> away;
          for (unsigned int d = 0; d < 2; ++d)
            away[d] = std::max(
                {food.lower_corner[d] - x[d], x[d] - food.upper_corner[d], 0.});
          if (away.norm() < least)
            {
              least = away.norm();
              along = nodes[second] - nodes[first];
            }
        }
      return std::abs(along[1]) > std::abs(along[0]) ? 0 : 1;
    }


    /// Pressure 1 Pa on the part of the surface that faces the food.
    Eigen::VectorXd
    pressure_of_food(const FE::ElasticBody     &body,
                     const Scene::ParticleBody &food,
                     const unsigned int         axis,
                     const double               depth)
    {
      const auto  &nodes = body.surface_nodes();
      const double middle =
          0.5 * (food.shape.lower_corner[axis] + food.shape.upper_corner[axis]);
      const unsigned int across = 1 - axis;
      Eigen::VectorXd    f      = Eigen::VectorXd::Zero(2 * nodes.size());
      for (const auto &[first, second] : body.surface_facets())
        {
          const auto                 edge = nodes[second] - nodes[first];
          const dealii::Point<2>     x    = nodes[first] + 0.5 * edge;
          const dealii::Tensor<1, 2> outward({edge[1], -edge[0]});
          if (outward[axis] * (middle - x[axis]) <= 0. ||
              x[across] < food.shape.lower_corner[across] ||
              x[across] > food.shape.upper_corner[across])
            continue;
          for (const unsigned int k : {first, second})
            for (unsigned int d = 0; d < 2; ++d)
              f[2 * k + d] -= 0.5 * depth * outward[d];
        }
      return f;
    }


    /// From the beginning of contact to the food's failure, or to the end of
    /// the run [s]; infinite if nothing moves.
    double
    loading_time(const Scene::Scene        &scene,
                 const Scene::ParticleBody &food,
                 const double               food_compliance,
                 const double               height)
    {
      double speed = 0.;
      for (const auto &plate : scene.plate_bodies)
        if (!plate.motion.is_prescribed())
          return scene.time.end_time;
      for (const auto &plate : scene.plate_bodies)
        speed += plate.motion.typical_velocity().norm();
      if (speed == 0.)
        return 0.;
      const double strength = food.material.compressive_strength;
      const double closure  = strength > 0.
                                  ? strength * food_compliance
                                  : scene.stop.maximum_closure * height;
      return std::min(scene.time.end_time, closure / speed);
    }


    bool
    meets_plates(const Scene::Scene &scene, const std::string &plate)
    {
      return std::any_of(scene.plate_pairs.begin(),
                         scene.plate_pairs.end(),
                         [&](const Scene::PairOfAKind &pair) {
                           return pair.first == plate || pair.second == plate;
                         });
    }
  } // namespace


  std::unique_ptr<FE::ElasticBody>
  make_elastic_body(const Scene::Scene &scene, const Scene::PlateBody &plate)
  {
    const auto &given = plate.deformation;
    auto        mesh  = std::make_unique<dealii::Triangulation<2>>(
        dealii::Triangulation<2>::limit_level_difference_at_vertices);
    if (plate.shape.is_mesh())
      plate.shape.place_mesh(*mesh);
    else
      {
        const double side =
            std::min(plate.shape.extent(0), plate.shape.extent(1));
        const double size =
            given.cell_size > 0.
                ? given.cell_size
                : std::min(
                      side,
                      std::max(0.125 * side,
                               2. * scene.particle_bodies.front().spacing));
        unsigned int n[2];
        for (unsigned int d = 0; d < 2; ++d)
          n[d] = std::max(1., std::ceil(plate.shape.extent(d) / size - 1e-9));
        FE::make_plate(*mesh,
                       plate.shape.lower_corner,
                       plate.shape.upper_corner,
                       n[0],
                       n[1]);
      }

    FE::ElasticBodyProperties properties;
    properties.youngs_modulus = given.youngs_modulus;
    properties.poissons_ratio = given.poissons_ratio;
    properties.density        = given.density;
    properties.depth          = scene.depth;
    properties.degree         = given.degree;
    properties.held           = held_ids(plate);

    const FE::ElasticBodyCracks cracks = cracks_of(plate);
    for (const auto &tip : Fracture::collect_tips(cracks.cracks))
      FE::refine_towards(
          *mesh, tip.position, given.tip_refinements, refined_layers);
    return std::make_unique<FE::ElasticBody>(
        std::move(mesh), properties, cracks);
  }


  void
  check_cracked_bodies(const Scene::Scene &scene)
  {
    for (const auto &plate : scene.plate_bodies)
      if (plate.deformation.elastic && !plate.cracks.paths.empty())
        make_elastic_body(scene, plate);
  }


  ResponseChoice
  choose_response(const Scene::Scene     &scene,
                  const Scene::PlateBody &plate,
                  const FE::ElasticBody  &body)
  {
    const auto &given = plate.deformation;
    if (given.response != "auto")
      return {given.response, "the scene says so"};
    if (!body.is_held())
      return {"dynamic", "nothing holds it"};

    const auto        &food = scene.particle_bodies.front();
    const unsigned int axis = axis_towards(food.shape, body);

    const Eigen::VectorXd f = pressure_of_food(body, food, axis, scene.depth);
    const Eigen::VectorXd u =
        body.factorise(1., 0.).solve(body.trace().transpose() * f);
    const double yields = (body.trace() * u).lpNorm<Eigen::Infinity>();
    const double nu     = food.material.poissons_ratio;
    const double height = food.shape.extent(axis);
    const double food_yields =
        height * (1. - nu * nu) / food.material.youngs_modulus;
    const double      ratio = yields / food_yields;
    const std::string cracked =
        body.cracks() ? "K of its cracks needs its deformation; " : "";
    const std::string share =
        cracked + "it yields " + number_text(100. * ratio) +
        " % of what the food does under the same pressure (tolerance " +
        number_text(100. * given.tolerance) + " %)";
    if (ratio < given.tolerance && !body.cracks())
      return {"rigid", share};

    const double period =
        2. * dealii::numbers::PI *
        std::sqrt(u.dot(body.mass() * u) / u.dot(body.stiffness() * u));
    const double      time = loading_time(scene, food, food_yields, height);
    const std::string times =
        share + ", and its period of " + number_text(period) +
        " s compares with a loading of " + number_text(time) + " s";
    const bool quasi_static_can =
        scene.contact.law == "gap penalty" && !meets_plates(scene, plate.name);
    const bool scaled      = scene.time.inertia_factor != 1.;
    const bool dynamic_can = plate.motion.carries_dynamic_bodies() && !scaled;
    if (!quasi_static_can && !dynamic_can)
      throw InputError(
          "'Body " + plate.name +
          "/Deformation/Response' = 'auto' finds none that does: " + times +
          "; 'quasi-static' needs the gap penalty and no contact "
          "with other plates (name the others in 'Contact/Pairs'), 'dynamic' a "
          "prescribed motion that does not turn the body and 'Time/Mass "
          "scaling' = 1.");
    if (!quasi_static_can)
      return {"dynamic",
              times + "; 'quasi-static' needs the gap penalty and no "
                      "contact with other plates"};
    if (!dynamic_can)
      return {"quasi-static",
              times + (scaled ? "; 'dynamic' needs 'Time/Mass scaling' = 1"
                              : "; 'dynamic' needs a prescribed motion that "
                                "does not turn the body")};
    return {period > quick_answer * time ? "dynamic" : "quasi-static", times};
  }
} // namespace Morsel
