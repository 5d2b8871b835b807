#include <morsel/core/errors.h>
#include <morsel/core/expression.h>
#include <morsel/core/sentences.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/static_body.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using Scene::Condition;

  namespace
  {
    EquilibriumMethod
    method_of(const Scene::ParticleBody &body)
    {
      return {kernel_named(body.solid.kernel),
              body.solid.smoothing_ratio,
              body.solid.normalisation == "auto"
                  ? Normalisation::conforming
                  : normalisation_named(body.solid.normalisation),
              body.solid.hourglass};
    }


    Fracture::ElasticPlane
    material_of(const Scene::ParticleBody &body)
    {
      return Fracture::ElasticPlane(body.material.youngs_modulus,
                                    body.material.poissons_ratio,
                                    body.material.plane_stress);
    }


    /// The axis across a side of a rectangle, or 2.
    unsigned int
    axis_across(const Condition &condition, const Scene::ParticleBody &body)
    {
      if (!body.shape.is_rectangle() ||
          condition.side() == Condition::Side::none)
        return 2;
      return condition.side() == Condition::Side::left ||
                     condition.side() == Condition::Side::right
                 ? 0
                 : 1;
    }


    /// Cuts a facet off at a box.
    /// @param across axis along which the box does not count, if below 2
    /// @return whether something is left
    bool
    cut_off(const Scene::Rectangle &box,
            const unsigned int      across,
            CellFacet              &facet)
    {
      double             begin = 0., end = 1.;
      const Point<2>     a = facet.first;
      const Tensor<1, 2> d = facet.second - facet.first;
      for (unsigned int k = 0; k < 2; ++k)
        {
          if (k == across)
            continue;
          const double low  = box.lower_corner[k] - a[k],
                       high = box.upper_corner[k] - a[k];
          if (d[k] == 0.)
            {
              if (low > 0. || high < 0.)
                return false;
              continue;
            }
          begin = std::max(begin, std::min(low / d[k], high / d[k]));
          end   = std::min(end, std::max(low / d[k], high / d[k]));
        }
      facet.first  = a + begin * d;
      facet.second = a + end * d;
      return end > begin;
    }
  } // namespace


  StaticBody::StaticBody(const Scene::Scene        &scene,
                         const Scene::ParticleBody &body)
      : StaticBody(scene, body, TimedCloud(body, scene.seed))
  {}


  StaticBody::TimedCloud::TimedCloud(const Scene::ParticleBody &body,
                                     const unsigned int         seed)
  {
    const dealii::Timer timer;
    cloud   = body_cloud(body, seed);
    seconds = timer.wall_time();
  }


  StaticBody::StaticBody(const Scene::Scene        &scene,
                         const Scene::ParticleBody &body,
                         const TimedCloud          &filled)
      : Equilibrium(filled.cloud,
                    visibility_in(
                        body,
                        filled.cloud.points,
                        KernelShapes::support(kernel_named(body.solid.kernel)) *
                            body.solid.smoothing_ratio * body.spacing),
                    method_of(body),
                    material_of(body),
                    body.material.youngs_modulus)
      , scene(scene)
      , body(body)
      , outline(body.shape.outline())
  {
    results.cloud_time  = filled.seconds;
    results.cells       = evenness(get_cloud());
    results.n_particles = get_cloud().size();
    prepare([this](StaticSolid &solid) { apply_conditions(solid); }, results);
  }


  const StaticBodyResults &
  StaticBody::run()
  {
    solve(results);
    results.tips = evaluate_tips(get_field(),
                                 cracks_of(body),
                                 get_material(),
                                 body.cracks.ring_radius,
                                 false);
    for (const Support &support : supports)
      results.forces.push_back(
          {support.condition,
           scene.depth * get_solid().reaction(support.begin, support.end)});
    return results;
  }


  Fracture::DisplacementSample
  StaticBody::observe(const Point<2> &place) const
  {
    const auto &points = get_cloud().points;
    return get_field().sample_from(
        *std::min_element(points.begin(),
                          points.end(),
                          [&](auto &a, auto &b) {
                            return place.distance_square(a) <
                                   place.distance_square(b);
                          }),
        place);
  }


  void
  StaticBody::apply_conditions(StaticSolid &solid)
  {
    for (unsigned int k = 0; k < scene.conditions.size(); ++k)
      {
        const Condition &condition = scene.conditions[k];
        if (condition.body != body.name)
          continue;
        if (condition.prescribes_motion())
          {
            const unsigned int begin = solid.n_supports();
            if (condition.on_side())
              support_side(condition, solid);
            else
              support_particles(condition, solid);
            if (solid.n_supports() == begin)
              throw InputError("'Condition " + condition.name +
                               "' holds nothing of body '" + body.name +
                               "': its box reaches no particle, or no part of "
                               "the side.");
            supports.push_back({k, begin, solid.n_supports()});
            continue;
          }
        const bool on_boundary =
            condition.on_side() && condition.kind != "acceleration";
        const Tensor<1, 2> force = on_boundary
                                       ? load_side(condition, solid)
                                       : load_particles(condition, solid);
        results.forces.push_back({k, scene.depth * force});
      }
    try
      {
        results.n_free_motions = solid.pin_free_motions();
      }
    catch (const InputError &error)
      {
        throw InputError("Body '" + body.name +
                         "' has no equilibrium: " + as_sentence(error.what()));
      }
  }


  bool
  StaticBody::concerns(const Condition &condition, const Point<2> &x) const
  {
    if (!condition.has_box())
      return true;
    const unsigned int across = axis_across(condition, body);
    for (unsigned int d = 0; d < 2; ++d)
      if (d != across && (x[d] < condition.box.lower_corner[d] ||
                          x[d] > condition.box.upper_corner[d]))
        return false;
    return true;
  }


  template <typename Use>
  void
  StaticBody::for_each_facet(const Condition &condition, const Use &use) const
  {
    const unsigned int side = outline.side_named(condition.where);
    for (unsigned int i = 0; i < get_cloud().size(); ++i)
      for (CellFacet facet : get_cloud().cells[i].facets)
        if (facet.at_boundary() && facet.side == side &&
            (!condition.has_box() ||
             cut_off(condition.box, axis_across(condition, body), facet)))
          use(i, facet);
  }


  Tensor<1, 2>
  StaticBody::load_side(const Condition &condition, StaticSolid &solid) const
  {
    double length = 0.;
    for_each_facet(condition, [&](unsigned int, const CellFacet &facet) {
      length += facet.length();
    });
    if (!(length > 0.))
      throw InputError("'Condition " + condition.name +
                       "' loads nothing of body '" + body.name +
                       "': its box reaches no part of the side.");
    // Tractions in Pa; a force in N is spread over the side.
    const double unit =
        condition.kind == "force" ? 1. / (length * scene.depth) : 1.;
    const VectorExpression value(condition.value);
    Tensor<1, 2>           total;
    ShapeValues            values;
    for_each_facet(condition,
                   [&](const unsigned int i, const CellFacet &facet) {
                     for (const Point<2> &x : gauss_points(facet))
                       {
                         const Tensor<1, 2> force =
                             0.5 * facet.length() * unit *
                             condition.traction(value(x, scene.time.end_time),
                                                facet.normal());
                         get_shape().evaluate(get_cloud().points[i], x, values);
                         solid.apply_force(values, force);
                         total += force;
                       }
                   });
    return total;
  }


  Tensor<1, 2>
  StaticBody::load_particles(const Condition &condition,
                             StaticSolid     &solid) const
  {
    const Cloud &cloud  = get_cloud();
    double       volume = 0.;
    for (unsigned int i = 0; i < cloud.size(); ++i)
      if (concerns(condition, cloud.points[i]))
        volume += cloud.cells[i].area;
    if (!(volume > 0.))
      throw InputError("'Condition " + condition.name +
                       "' loads nothing of body '" + body.name +
                       "': its box holds no particle.");
    const double           unit = condition.kind == "acceleration"
                                      ? body.material.density
                                      : 1. / (volume * scene.depth);
    const VectorExpression value(condition.value);
    Tensor<1, 2>           total;
    for (unsigned int i = 0; i < cloud.size(); ++i)
      if (concerns(condition, cloud.points[i]))
        {
          const Tensor<1, 2> force =
              unit * cloud.cells[i].area *
              value(cloud.points[i], scene.time.end_time);
          solid.apply_force(i, force);
          total += force;
        }
    return total;
  }


  void
  StaticBody::support_side(const Condition &condition, StaticSolid &solid) const
  {
    const VectorExpression value(condition.value);
    const unsigned int     side = outline.side_named(condition.where);
    for (const BoundaryFacet &facet : get_boundary())
      {
        if (facet.side != side || !concerns(condition, facet.centre))
          continue;
        if (condition.kind == "roller")
          {
            solid.hold_across(facet);
            continue;
          }
        const Tensor<1, 2> u = condition.kind == "displacement"
                                   ? value(facet.centre, scene.time.end_time)
                                   : Tensor<1, 2>();
        for (unsigned int d = 0; d < 2; ++d)
          if (condition.prescribes(d))
            solid.hold(facet, d, u[d]);
      }
  }


  void
  StaticBody::support_particles(const Condition &condition,
                                StaticSolid     &solid) const
  {
    const VectorExpression value(condition.value);
    for (unsigned int i = 0; i < get_cloud().size(); ++i)
      {
        const Point<2> &x = get_cloud().points[i];
        if (!concerns(condition, x))
          continue;
        const Tensor<1, 2> u = condition.kind == "displacement"
                                   ? value(x, scene.time.end_time)
                                   : Tensor<1, 2>();
        for (unsigned int d = 0; d < 2; ++d)
          if (condition.prescribes(d))
            solid.pin({{i}, {1.}}, d, u[d]);
      }
  }
} // namespace Morsel::SPH
