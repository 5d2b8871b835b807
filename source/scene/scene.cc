#include <morsel/core/expression.h>
#include <morsel/scene/scene.h>

#include <deal.II/base/patterns.h>

#include <cmath>
#include <random>

namespace Morsel::Scene
{
  namespace Patterns = dealii::Patterns;

  void
  Rectangle::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "Corner 'x, y' of least coordinates [m].");
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "Corner 'x, y' of largest coordinates [m].");
  }


  void
  ParticleBody::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Shape");
    shape.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Particles");
    prm.add_parameter(
        "Particles across",
        particles_across,
        "Number of particles along x; they stand on a square lattice, the "
        "first and last half a spacing inside the edges [1]. The spacing is "
        "the shape's extent along x over it.",
        Patterns::Integer(0));
    prm.add_parameter(
        "Filling",
        filling,
        "'lattice', of which a shape that is no rectangle holds the particles "
        "that have room in it; 'relaxed': rows along the boundary, the rest "
        "evened out by Lloyd iterations.",
        Patterns::Selection("lattice|relaxed"));
    prm.add_parameter(
        "Lattice angle",
        lattice_angle,
        "By how much the lattice is turned about the middle of the shape, "
        "from x to y [degrees]. A rectangle then holds the particles that "
        "have room in it, as other shapes do.",
        Patterns::Double(-90., 90.));
    prm.add_parameter("Relaxations",
                      relaxations,
                      "Lloyd iterations of a relaxed filling, at most [1].",
                      Patterns::Integer(0, 10000));
    prm.add_parameter("Scatter",
                      scatter,
                      "Largest displacement of a particle from its place in "
                      "the lattice along x and y, in spacings [1].",
                      Patterns::Double(0., 0.45));
    prm.add_parameter("Initial velocity",
                      initial_velocity,
                      "Velocity 'v_x, v_y' of all particles at time 0 [m/s].");
    prm.add_parameter("Initial velocity field",
                      initial_velocity_field,
                      "Velocity at time 0 that adds to it, as expressions "
                      "'f_x; f_y' of the place x, y [m] [m/s]; none if empty.");
    prm.add_parameter(
        "Initial stress",
        initial_stress,
        "Stress 'xx, yy, xy' of all particles at time 0 [Pa], at "
        "no strain; none if empty. Updated Lagrangian form only.");
    prm.add_parameter("Expected velocity gradient",
                      expected_velocity_gradient,
                      "Gradient 'xx, xy, yx, yy' of the velocity at time 0 "
                      "[1/s] with which the particles' own is compared; none "
                      "if empty.");
    prm.add_parameter("Expected displacement field",
                      expected_displacement_field,
                      "Displacement of a static solution with which the "
                      "particles' own is compared, as expressions 'f_x; f_y' "
                      "of the place x, y [m] [m]; none if empty.");
    prm.leave_subsection();

    prm.enter_subsection("Cracks");
    cracks.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Material");
    material.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Grains");
    grains.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Damage");
    damage = Materials::DamageParameters::left_open();
    damage.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Solid");
    solid.declare(prm);
    prm.leave_subsection();
  }


  unsigned int
  ParticleBody::particles_high() const
  {
    return spacing > 0. ? static_cast<unsigned int>(
                              std::lround(shape.extent(1) / spacing))
                        : 0;
  }


  std::vector<dealii::Point<2>>
  ParticleBody::positions(const unsigned int seed) const
  {
    const unsigned int nx = particles_across, ny = particles_high();
    std::mt19937       generator(seed);
    // Not uniform_real_distribution, which differs between libraries.
    const auto throw_off = [&] {
      return scatter * spacing * (2. * (generator() / 4294967295.) - 1.);
    };
    std::vector<dealii::Point<2>> points;
    points.reserve(static_cast<std::size_t>(nx) * ny);
    for (unsigned int y = 0; y < ny; ++y)
      for (unsigned int x = 0; x < nx; ++x)
        {
          dealii::Point<2> p(
              shape.lower_corner[0] + shape.extent(0) * ((x + 0.5) / nx),
              shape.lower_corner[1] + shape.extent(1) * ((y + 0.5) / ny));
          if (scatter > 0.)
            {
              p[0] += throw_off();
              p[1] += throw_off();
            }
          points.push_back(p);
        }
    return points;
  }


  std::string
  ParticleBody::normalisation() const
  {
    if (solid.normalisation != "auto")
      return solid.normalisation;
    return is_even_lattice() || solid.is_updated() ? "gradient matrix"
                                                   : "conforming";
  }


  std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &)>
  ParticleBody::initial_velocity_function() const
  {
    const dealii::Tensor<1, 2> uniform = initial_velocity;
    if (initial_velocity_field.empty())
      return [uniform](const dealii::Point<2> &) { return uniform; };
    const auto field =
        std::make_shared<VectorExpression>(initial_velocity_field);
    return [uniform, field](const dealii::Point<2> &x) {
      return uniform + (*field)(x, 0.);
    };
  }


  void
  PlateBody::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Shape");
    shape.declare(prm);
    prm.leave_subsection();

    // An elastic body has the nodes of its mesh.
    if (!deformation.elastic)
      {
        prm.enter_subsection("Surface");
        prm.add_parameter("Node spacing",
                          node_spacing,
                          "Spacing of the nodes on the surface [m]; 0 takes "
                          "half the particle spacing of the food.",
                          Patterns::Double(0.));
        prm.leave_subsection();
      }

    prm.enter_subsection("Motion");
    motion.declare(prm);
    prm.leave_subsection();

    if (deformation.elastic)
      {
        deformation.declare(prm);
        prm.enter_subsection("Cracks");
        cracks.declare(prm,
                       "Its mesh knows nothing of them; their stress "
                       "intensities are followed over time.");
        prm.leave_subsection();
      }
  }


  void
  TimeParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Solution",
        solution,
        "'transient': time steps; 'static': the equilibrium at small strain "
        "under the conditions as they are at the end time, without plates.",
        Patterns::Selection("transient|static"));
    prm.add_parameter("End time",
                      end_time,
                      "The run ends at this time at the latest [s].",
                      Patterns::Double(0.));
    prm.add_parameter("Time step",
                      time_step,
                      "Fixed time step [s]; 0 takes the largest stable one.",
                      Patterns::Double(0.));
    prm.add_parameter(
        "Mass scaling",
        mass_scaling,
        "Quasi-static scenes: density of all particles that their inertia "
        "sees, over their material's [1]. Steps grow by its square root, and "
        "all comes out as with plates faster by as much. 0 takes the largest "
        "factor with which kinetic energy stays below 'Kinetic share'.",
        Patterns::Double(0., 1e8));
    prm.add_parameter("Kinetic share",
                      kinetic_share,
                      "With mass scaling: kinetic over strain energy before "
                      "the food fails, at most [1]; more is warned of.",
                      Patterns::Double(1e-8, 1.));
    prm.add_parameter("Retries",
                      retries,
                      "Where a guard finds bad numbers, the run goes back to "
                      "the last good state and on with half the time step, at "
                      "most so many times [1]; 0 stops it at once.",
                      Patterns::Integer(0, 20));
  }


  void
  RankParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Repartition",
                      repartition,
                      "With mpirun: whether particles change ranks as the food "
                      "breaks and broken food takes more time, where that "
                      "pays.");
  }


  void
  StopParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Maximum closure",
        maximum_closure,
        "The run ends when the plates have come together by this share of the "
        "food's height [1].",
        Patterns::Double());
    prm.add_parameter(
        "Residual force",
        residual_force,
        "Complete failure: after its peak the mean occlusal force (without "
        "plates that of the conditions that move) has fallen below this share "
        "of the peak [1]; 0 never ends the run.",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Closure after failure",
        closure_after_failure,
        "After complete failure the run goes on until the plates (or these "
        "conditions) have moved by this further share of the food's height "
        "[1].",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Minimum spacing",
        minimum_spacing,
        "Without plates: the run ends when two particles of a body come closer "
        "than this, in particle spacings [1]; 0 never ends it.",
        Patterns::Double(0., 1.));
  }


  void
  OutputParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Fields", fields, "Write the fields over time for ParaView.");
    prm.add_parameter("Field frames",
                      field_frames,
                      "About so many moments at which fields are written [1].",
                      Patterns::Integer(0, 100000));
    prm.add_parameter("History samples",
                      history_samples,
                      "At most about so many rows of the history [1].",
                      Patterns::Integer(2, 10000000));
    prm.add_parameter("Checkpoint interval",
                      checkpoint_interval,
                      "Wall time from one checkpoint to the next, from which "
                      "--resume goes on [min]; 0 = only on signals.",
                      Patterns::Double(0., 1e6));
    prm.add_parameter("Checkpoints kept",
                      checkpoints_kept,
                      "How many of the newest checkpoints are kept [1].",
                      Patterns::Integer(1, 1000));
  }


  void
  MeasureParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Fragment share",
        fragment_share,
        "Smallest share of the food's mass that counts as a fragment [1].",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Friend distance",
        friend_distance,
        "Unfailed particles this close belong to the same fragment, in "
        "particle spacings [1].",
        Patterns::Double(0.5, 10.));
  }
} // namespace Morsel::Scene
