#include <morsel/sph/equilibrium.h>

#include <deal.II/base/timer.h>

namespace Morsel::SPH
{
  using dealii::Point;

  Equilibrium::Equilibrium(Cloud                         given_cloud,
                           const Visibility             &visibility,
                           const EquilibriumMethod      &method,
                           const Fracture::ElasticPlane &material,
                           const double                  youngs_modulus)
      : cloud(std::move(given_cloud))
      , visibility(visibility)
      , method(method)
      , material(material)
      , youngs_modulus(youngs_modulus)
      , shape(cloud,
              Kernel(method.kernel, method.smoothing_ratio * cloud.spacing),
              this->visibility)
  {}


  void
  Equilibrium::prepare(
      const std::function<void(StaticSolid &)> &apply_conditions,
      EquilibriumResults                       &results)
  {
    dealii::Timer timer;
    gradient = method.gradient == Normalisation::conforming
                   ? conforming_gradient(shape)
                   : normalised_gradient(shape, method.gradient);
    control  = residual_control(shape, method.hourglass * youngs_modulus);
    boundary = boundary_facets(shape);
    results.operator_time = timer.wall_time();
    results.n_particles   = cloud.size();
    results.n_neighbours =
        static_cast<double>(gradient.list.index.size()) / cloud.size();

    solid = std::make_unique<StaticSolid>(
        shape, gradient, control, boundary, material, youngs_modulus);
    apply_conditions(*solid);
  }


  void
  Equilibrium::solve(EquilibriumResults &results)
  {
    displacement  = solid->solve();
    results.solve = solid->get_report();

    gradients.resize(cloud.size());
    for (unsigned int i = 0; i < cloud.size(); ++i)
      gradients[i] = gradient.gradient(i, displacement);
    results.strain_energy    = solid->strain_energy(displacement);
    results.hourglass_energy = control.energy(displacement);
    results.external_work    = solid->external_work(displacement);
  }
} // namespace Morsel::SPH
