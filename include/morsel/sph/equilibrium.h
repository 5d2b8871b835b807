#ifndef morsel_sph_equilibrium_h
#define morsel_sph_equilibrium_h

#include <morsel/fracture/tip_fields.h>
#include <morsel/sph/static_solid.h>
#include <morsel/sph/tip_sampling.h>

#include <functional>
#include <memory>
#include <vector>

namespace Morsel::SPH
{
  /// What the equilibrium of a particle body comes to.
  struct EquilibriumResults
  {
    double strain_energy    = 0.; ///< [J/m], all of it
    double hourglass_energy = 0.; ///< part of it [J/m]
    /// Of loads and prescribed displacements that grow in proportion [J/m].
    double       external_work = 0.;
    unsigned int n_particles   = 0;
    double       n_neighbours  = 0.; ///< of a particle, mean
    StaticReport solve;
    double       cloud_time = 0., operator_time = 0.; ///< [s]
  };


  /// How a particle body is discretised, its cloud apart.
  struct EquilibriumMethod
  {
    KernelKind    kernel          = KernelKind::cubic_b_spline;
    double        smoothing_ratio = 1.3;
    Normalisation gradient        = Normalisation::conforming;
    double        hourglass       = 0.3; ///< [Young's moduli]
  };


  /// A particle body in equilibrium at small strain: what cracked plates and
  /// experiments on bodies of any shape have in common.
  class Equilibrium
  {
  public:
    Equilibrium(Cloud                         cloud,
                const Visibility             &visibility,
                const EquilibriumMethod      &method,
                const Fracture::ElasticPlane &material,
                const double                  youngs_modulus);

    Equilibrium(const Equilibrium &) = delete;

    const Cloud &
    get_cloud() const
    {
      return cloud;
    }

    const VectorField &
    get_displacement() const
    {
      return displacement;
    }

    /// H_i of the particles [1].
    const TensorField &
    get_gradients() const
    {
      return gradients;
    }

    const Fracture::ElasticPlane &
    get_material() const
    {
      return material;
    }

    /// The solution, to be asked anywhere.
    CloudField
    get_field() const
    {
      return {shape, displacement, gradients};
    }

  protected:
    /// Operators, supports and loads.
    void
    prepare(const std::function<void(StaticSolid &)> &apply_conditions,
            EquilibriumResults                       &results);

    /// The solution and its energies. @pre prepare()
    void
    solve(EquilibriumResults &results);

    const ShapeFunctions &
    get_shape() const
    {
      return shape;
    }

    const std::vector<BoundaryFacet> &
    get_boundary() const
    {
      return boundary;
    }

    /// @pre prepare()
    const StaticSolid &
    get_solid() const
    {
      return *solid;
    }

  private:
    Cloud                        cloud;
    Visibility                   visibility;
    EquilibriumMethod            method;
    Fracture::ElasticPlane       material;
    double                       youngs_modulus;
    ShapeFunctions               shape;
    DiscreteGradient             gradient;
    ResidualControl              control;
    std::vector<BoundaryFacet>   boundary;
    std::unique_ptr<StaticSolid> solid;
    VectorField                  displacement; ///< [m]
    TensorField                  gradients;    ///< H_i [1]
  };
} // namespace Morsel::SPH

#endif
