#ifndef morsel_sph_plate_problem_h
#define morsel_sph_plate_problem_h

#include <morsel/fracture/plate_scene.h>
#include <morsel/sph/equilibrium.h>
#include <morsel/sph/plate_discretisation.h>
#include <morsel/sph/tip_sampling.h>

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
  struct PlateResults : EquilibriumResults
  {
    std::vector<Fracture::TipResult> tips;
    double                           tip_time = 0.; ///< [s]
  };


  /// A cracked plate of particles from its parameters: cloud, discrete
  /// gradient, supports and loads, solution, stress intensities.
  class PlateProblem : public Equilibrium
  {
  public:
    /// @param cracks those of the parameters, or grown ones
    PlateProblem(const PlateParameters              &parameters,
                 const std::vector<Fracture::Crack> &cracks);

    /// Does everything.
    const PlateResults &
    run();

    const std::vector<Fracture::CrackTip> &
    get_tips() const
    {
      return tips;
    }

    const PlateResults &
    get_results() const
    {
      return results;
    }

  private:
    /// @param cloud_time for its wall time [s]
    PlateProblem(const PlateParameters              &parameters,
                 const std::vector<Fracture::Crack> &cracks,
                 double                              cloud_time);

    void
    apply_boundary_conditions(StaticSolid &solid) const;

    PlateParameters                 parameters;
    std::vector<Fracture::Crack>    cracks;
    std::vector<Fracture::CrackTip> tips;
    PlateResults                    results;
  };


  /// sqrt(E' G) by the energy difference T3-47, with the tips moved ahead by
  /// the parameters' energy growth [Pa sqrt(m)].
  /// @param energy strain energy at the present length [J/m]
  double
  energy_route(const PlateParameters &parameters, const double energy);
} // namespace Morsel::SPH

#endif
