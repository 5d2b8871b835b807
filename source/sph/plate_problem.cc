#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture/energy_release.h>
#include <morsel/sph/plate_problem.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <array>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Timer;

  namespace
  {
    double
    particle_spacing(const PlateParameters &plate)
    {
      const Tensor<1, 2> size = plate.upper_corner - plate.lower_corner;
      return std::sqrt(size[0] / plate.particles_x * size[1] /
                       plate.particles_y);
    }


    /// The cloud, and the time that it took.
    Cloud
    fill(const PlateParameters              &plate,
         const std::vector<Fracture::Crack> &cracks,
         double                             &seconds)
    {
      Timer   timer;
      Filling filling;
      filling.lower         = plate.lower_corner;
      filling.upper         = plate.upper_corner;
      filling.n_x           = plate.particles_x;
      filling.n_y           = plate.particles_y;
      filling.fit_to_cracks = plate.fit_to_cracks;
      filling.scatter       = plate.scatter;
      filling.seed          = plate.seed;
      const Cloud cloud     = fill_rectangle(filling, cracks);
      seconds               = timer.wall_time();
      return cloud;
    }


    EquilibriumMethod
    method_of(const PlateParameters &plate)
    {
      return {kernel_named(plate.kernel),
              plate.smoothing_ratio,
              normalisation_named(plate.gradient),
              plate.hourglass};
    }
  } // namespace


  void
  check(const PlateParameters &plate)
  {
    Fracture::check(plate);
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    if (n_ranks > 1)
      throw InputError("'Method = SPH' runs a cracked plate on one rank, but " +
                       std::to_string(n_ranks) +
                       " are given: leave mpirun out, or choose 'XFEM'.");
    const Tensor<1, 2> size = plate.upper_corner - plate.lower_corner;
    const double       ratio =
        size[0] / plate.particles_x / (size[1] / plate.particles_y);
    if (ratio < 0.8 || ratio > 1.25)
      throw InputError(
          "'SPH/Particles along x' and 'along y' give spacings of " +
          number_text(size[0] / plate.particles_x) + " and " +
          number_text(size[1] / plate.particles_y) +
          " m, but the one must be between 0.8 and 1.25 of the other.");
  }


  PlateProblem::PlateProblem(const PlateParameters              &parameters,
                             const std::vector<Fracture::Crack> &cracks)
      : PlateProblem(parameters, cracks, 0.)
  {}


  PlateProblem::PlateProblem(const PlateParameters              &parameters,
                             const std::vector<Fracture::Crack> &cracks,
                             double                              cloud_time)
      : Equilibrium(
            fill(parameters, cracks, cloud_time),
            Visibility(cracks,
                       tip_handling_named(parameters.tip_handling),
                       KernelShapes::support(kernel_named(parameters.kernel)) *
                           parameters.smoothing_ratio *
                           particle_spacing(parameters)),
            method_of(parameters),
            Fracture::ElasticPlane(parameters.youngs_modulus,
                                   parameters.poissons_ratio,
                                   parameters.plane_stress),
            parameters.youngs_modulus)
      , parameters(parameters)
      , cracks(cracks)
      , tips(Fracture::collect_tips(cracks))
  {
    results.n_particles = get_cloud().size();
    results.cloud_time  = cloud_time;
  }


  void
  PlateProblem::apply_boundary_conditions(StaticSolid &solid) const
  {
    bool held[2]  = {false, false};
    bool no_turns = false;
    for (unsigned int side = 0; side < 4; ++side)
      {
        const unsigned int normal  = side < 2 ? 0 : 1;
        const std::string &support = parameters.support[side];
        const Tensor<1, 2> displacement =
            Fracture::displacement_of(parameters, side);
        if (support != "free")
          {
            solid.hold(side, normal, displacement[normal]);
            held[normal] = no_turns = true;
          }
        if (support == "clamp" || support == "displacement")
          {
            solid.hold(side, 1 - normal, displacement[1 - normal]);
            held[1 - normal] = true;
          }
        const Tensor<1, 2> traction = Fracture::traction_on(parameters, side);
        if (traction.norm() > 0.)
          solid.apply_traction(side, traction);
      }
    const auto pin = [&](const Point<2> &place, const unsigned int component) {
      ShapeValues values;
      get_shape().evaluate(place, place, values);
      solid.pin(values, component);
    };
    const Point<2> &low  = parameters.lower_corner;
    const Point<2> &high = parameters.upper_corner;
    for (unsigned int d = 0; d < 2; ++d)
      if (!held[d])
        pin(Point<2>(high[0], low[1]), d);
    if (!no_turns)
      pin(high, 0);
  }


  const PlateResults &
  PlateProblem::run()
  {
    prepare([this](StaticSolid &solid) { apply_boundary_conditions(solid); },
            results);
    solve(results);

    Timer timer;
    results.tips     = evaluate_tips(get_field(),
                                 cracks,
                                 get_material(),
                                 parameters.ring_radius,
                                 parameters.two_directions);
    results.tip_time = timer.wall_time();
    return results;
  }


  double
  energy_route(const PlateParameters &parameters, const double energy)
  {
    const double          da = parameters.energy_growth;
    std::array<double, 3> energies{{energy, 0., 0.}};
    for (unsigned int i = 1; i < 3; ++i)
      {
        std::vector<Fracture::Crack> cracks;
        for (const Fracture::Crack &crack : make_cracks(parameters))
          cracks.push_back(crack.with_moved_tips(i * da));
        PlateProblem problem(parameters, cracks);
        energies[i] = problem.run().strain_energy;
      }
    const Fracture::ElasticPlane material(parameters.youngs_modulus,
                                          parameters.poissons_ratio,
                                          parameters.plane_stress);
    return Fracture::stress_intensity_of_energy(
        Fracture::energy_difference(
            energies, da, Fracture::held_quantity(parameters)),
        material.effective_modulus);
  }
} // namespace Morsel::SPH
