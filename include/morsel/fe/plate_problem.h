#ifndef morsel_fe_plate_problem_h
#define morsel_fe_plate_problem_h

#include <morsel/fe/discretisation.h>
#include <morsel/fe/stress_intensity.h>
#include <morsel/fracture/plate_scene.h>

#include <memory>

namespace Morsel::FE
{
  /// What extended finite elements need to know of a cracked plate.
  struct PlateParameters : Fracture::PlateScene, Discretisation
  {
    /// Binds all members to entries.
    void
    declare(dealii::ParameterHandler &prm)
    {
      PlateScene::declare(prm);
      Discretisation::declare(prm);
    }
  };


  /// Checks what no single entry shows, the plate itself included.
  /// @throws InputError, one sentence
  void
  check(const PlateParameters &parameters);


  /// The results of one cracked plate.
  struct PlateResults
  {
    std::vector<TipResult> tips;
    double                 strain_energy = 0.; ///< [J/m]
    double                 external_work = 0.; ///< [J/m]
    unsigned int           n_cells       = 0;
    SolveReport            solve;
    double                 mesh_time = 0., space_time = 0., tip_time = 0.;
    std::vector<double>    estimates; ///< error estimate, by adaptive step
  };


  /// A cracked plate from its parameters: mesh, space, supports and loads,
  /// solution, adaptive loop, stress intensities.
  class PlateProblem
  {
  public:
    /// @param triangulation empty; serial or distributed
    /// @param cracks those of the parameters, or grown ones
    PlateProblem(const PlateParameters              &parameters,
                 const std::vector<Fracture::Crack> &cracks,
                 dealii::Triangulation<2>           &triangulation);

    /// Does everything.
    const PlateResults &
    run();

    /// Everything but the stress intensities.
    const PlateResults &
    solve();

    /// Distributes the unknowns on the first mesh, without solving.
    void
    set_up();

    const XFEMSpace &
    get_space() const
    {
      return *space;
    }
    const ElasticProblem &
    get_problem() const
    {
      return *problem;
    }
    const ElasticProblem::Solution &
    get_solution() const
    {
      return solution;
    }

  private:
    void
    make_mesh();
    std::vector<unsigned int>
    cell_degrees() const;
    void
    solve_once();
    void
    apply_boundary_conditions();

    PlateParameters                 parameters;
    Fracture::ElasticPlane          material;
    dealii::Triangulation<2>       &triangulation;
    std::unique_ptr<XFEMSpace>      space;
    std::unique_ptr<ElasticProblem> problem;
    ElasticProblem::Solution        solution;
    PlateResults                    results;
  };


  /// sqrt(E' G) by the energy difference T3-47 on the same mesh with the
  /// tips moved ahead by the parameters' energy growth [Pa sqrt(m)]; where
  /// several tips grow, G is their sum.
  /// @param energy strain energy at the present length [J/m]
  double
  energy_route(const PlateParameters &parameters, const double energy);


  /// Residual estimate per cell: the tractions' jumps over its faces and the
  /// tractions missed on its loaded or free sides,
  /// eta^2 = h integral |t|^2 ds (Kelly et al. 1983), in the units of
  /// stress times length. Other ranks' cells get 0.
  dealii::Vector<float>
  estimate_errors(const ElasticProblem           &problem,
                  const ElasticProblem::Solution &solution);


  /// Flags the given share of all ranks' cells for refinement, those of the
  /// largest errors. Cells whose errors differ from one of them by round-off
  /// (symmetric plates have such) are flagged with it, so that the same cells
  /// are flagged on any number of ranks. Collective.
  /// @param errors by active cell index
  /// @param share  in (0, 1] [1]
  void
  mark_largest(dealii::Triangulation<2>    &triangulation,
               const dealii::Vector<float> &errors,
               const double                 share);
} // namespace Morsel::FE

#endif
