#ifndef morsel_sph_plate_problem_h
#define morsel_sph_plate_problem_h

#include <morsel/fracture/plate_scene.h>
#include <morsel/sph/plate_discretisation.h>
#include <morsel/sph/static_solid.h>
#include <morsel/sph/tip_sampling.h>

#include <memory>
#include <string>

namespace Morsel::SPH
{
  /// What particles need to know of a cracked plate.
  struct PlateParameters : Fracture::PlateScene, PlateDiscretisation
  {
  };


  /// Checks what no single entry shows, the plate itself included.
  /// @throws InputError, one sentence
  void
  check(const PlateParameters &parameters);


  /// The results of one cracked plate.
  struct PlateResults
  {
    std::vector<Fracture::TipResult> tips;
    double                           strain_energy = 0.; ///< [J/m], all of it
    double       hourglass_energy                  = 0.; ///< part of it [J/m]
    double       external_work                     = 0.; ///< [J/m]
    unsigned int n_particles                       = 0;
    double       n_neighbours = 0.; ///< of a particle, mean
    StaticReport solve;
    double       cloud_time = 0., operator_time = 0., tip_time = 0.; ///< [s]
  };


  /// A cracked plate of particles from its parameters: cloud, discrete
  /// gradient, supports and loads, solution, stress intensities.
  class PlateProblem
  {
  public:
    /// @param cracks those of the parameters, or grown ones
    PlateProblem(const PlateParameters              &parameters,
                 const std::vector<Fracture::Crack> &cracks);

    /// Does everything.
    const PlateResults &
    run();

    const Cloud &
    get_cloud() const
    {
      return cloud;
    }

    const std::vector<Fracture::CrackTip> &
    get_tips() const
    {
      return tips;
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

    const PlateResults &
    get_results() const
    {
      return results;
    }

    /// The solution, to be asked anywhere.
    CloudField
    get_field() const
    {
      return {*shape, displacement, gradients};
    }

    const Fracture::ElasticPlane &
    get_material() const
    {
      return material;
    }

  private:
    void
    apply_boundary_conditions(StaticSolid &solid) const;

    PlateParameters                 parameters;
    Fracture::ElasticPlane          material;
    std::vector<Fracture::Crack>    cracks;
    std::vector<Fracture::CrackTip> tips;
    Cloud                           cloud;
    Visibility                      visibility;
    std::unique_ptr<ShapeFunctions> shape;
    VectorField                     displacement; ///< [m]
    TensorField                     gradients;    ///< H_i [1]
    PlateResults                    results;
  };


  /// sqrt(E' G) by the energy difference T3-47, with the tips moved ahead by
  /// the parameters' energy growth [Pa sqrt(m)].
  /// @param energy strain energy at the present length [J/m]
  double
  energy_route(const PlateParameters &parameters, const double energy);
} // namespace Morsel::SPH

#endif
