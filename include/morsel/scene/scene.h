#ifndef morsel_scene_scene_h
#define morsel_scene_scene_h

#include <morsel/contact/parameters.h>
#include <morsel/fracture/parameters.h>
#include <morsel/jaw/hinge_parameters.h>
#include <morsel/jaw/motion.h>
#include <morsel/jaw/parameters.h>
#include <morsel/materials/grains.h>
#include <morsel/materials/parameters.h>
#include <morsel/scene/body_shape.h>
#include <morsel/scene/conditions.h>
#include <morsel/scene/plate_shape.h>
#include <morsel/scene/rectangle.h>
#include <morsel/sph/parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// A body of particles: the food, or any other solid.
  struct ParticleBody
  {
    std::string      name;
    BodyShape        shape;
    unsigned int     particles_across = 0;         ///< along x
    double           spacing          = 0.;        ///< dp [m], derived
    std::string      filling          = "lattice"; ///< or "relaxed"
    double           lattice_angle    = 0.;        ///< [degrees]
    unsigned int     relaxations      = 50;        ///< Lloyd iterations at most
    double           scatter          = 0.;        ///< in spacings [1]
    dealii::Point<2> initial_velocity;             ///< [m/s]
    std::string      initial_velocity_field;       ///< adds to it [m/s]
    std::string      initial_stress;               ///< xx, yy, xy [Pa] or empty
    /// Known gradient of the velocity at time 0, xx, xy, yx, yy [1/s]; empty
    /// where it is not asked for.
    std::string expected_velocity_gradient;
    /// Known displacement in equilibrium [m]; empty as above.
    std::string                   expected_displacement_field;
    Materials::MaterialParameters material; ///< completed from the catalogue
    Materials::GrainParameters    grains;
    Materials::DamageParameters   damage;
    Fracture::BodyCracks          cracks;
    SPH::SolidParameters          solid;

    void
    declare(dealii::ParameterHandler &prm);

    /// Rows of particles along y that fill the shape.
    unsigned int
    particles_high() const;

    /// Whether the particles are those of positions().
    bool
    is_plain_lattice() const
    {
      return shape.is_rectangle() && filling == "lattice" &&
             lattice_angle == 0.;
    }

    /// Whether all particles have a cell of the same size.
    bool
    is_even_lattice() const
    {
      return is_plain_lattice() && scatter == 0.;
    }

    /// The points of a rectangle's lattice, row by row along x, each thrown
    /// off its place by up to `scatter` spacings along x and y [m]. See
    /// SPH::body_cloud() for other shapes and fillings.
    std::vector<dealii::Point<2>>
    positions(unsigned int seed) const;

    /// The choice of 'Solid/Normalisation', with what 'auto' stands for: the
    /// gradient matrix on lattices and in the updated Lagrangian form, the
    /// conforming gradient on scattered particles.
    std::string
    normalisation() const;

    /// Velocity at time 0 as a function of the place [m/s].
    /// @throws InputError if the field is no expression.
    std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &)>
    initial_velocity_function() const;
  };


  /// A body that its drive moves: a plate or tooth, rigid or, where its
  /// deformation is elastic, held at some of its sides.
  struct PlateBody
  {
    std::string           name;
    PlateShape            shape;
    double                node_spacing = 0.; ///< of its surface [m], 0 = dp/2
    Jaw::MotionParameters motion;
    Jaw::DeformationParameters deformation;
    Fracture::CrackPaths       cracks; ///< of an elastic one

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// Two bodies that may touch: a particle body and a plate.
  struct ContactPair
  {
    std::string food;
    std::string plate;
  };


  /// Two bodies of the same kind that may meet: plates, or particle bodies.
  struct PairOfAKind
  {
    std::string first, second;
  };


  struct TimeParameters
  {
    std::string solution  = "transient"; ///< or "static"
    double      end_time  = 0.4;         ///< [s]
    double      time_step = 0.;          ///< [s], 0 = the stable step
    /// Density of particles that their inertia sees over their material's
    /// [1], for quasi-static scenes; 0 = by 'kinetic_share'.
    double mass_scaling = 1.;
    /// Largest kinetic over strain energy before failure [1].
    double kinetic_share = 1e-3;
    /// The factor that 'mass_scaling' stands for [1], derived.
    double inertia_factor = 1.;
    /// With half the step from a good state, where the numbers go bad.
    unsigned int retries = 4;

    bool
    is_static() const
    {
      return solution == "static";
    }

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// When to stop before the end time.
  struct StopParameters
  {
    double maximum_closure = 0.5; ///< of the food's height [1]
    /// Complete failure: after its peak the mean occlusal force has fallen
    /// below this share of it [1] ...
    double residual_force = 0.2;
    /// ... and the plates have closed this much further, relative to the
    /// food's height [1]. 0 with a residual force of 0: never.
    double closure_after_failure = 0.01;
    /// Smallest distance of two particles, in spacings [1]; 0: never.
    double minimum_spacing = 0.;

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct OutputParameters
  {
    bool         fields          = true;
    unsigned int field_frames    = 40;  ///< about so many moments
    unsigned int history_samples = 600; ///< about so many rows at most
    /// Of wall time from checkpoint to checkpoint [min], 0 = on signals only.
    double       checkpoint_interval = 10.;
    unsigned int checkpoints_kept    = 2;

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct MeasureParameters
  {
    double fragment_share  = 0.005; ///< smallest fragment, share of mass [1]
    double friend_distance = 1.2;   ///< in spacings [1]

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// How particles are shared out among MPI ranks.
  struct RankParameters
  {
    bool repartition = true; ///< as the food breaks

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// Everything that one run is about. Constant once read.
  struct Scene
  {
    std::string                        name;
    std::string                        title;
    double                             depth = 1.; ///< out of plane [m]
    unsigned int                       seed  = 1;
    Rectangle                          domain;
    std::vector<ParticleBody>          particle_bodies;
    std::vector<PlateBody>             plate_bodies;
    std::vector<ContactPair>           contact_pairs;
    std::vector<PairOfAKind>           plate_pairs, food_pairs;
    Jaw::HingeParameters               jaw;
    std::vector<Jaw::MuscleParameters> muscles;
    std::vector<Condition>             conditions;
    std::vector<Observer>              observers;
    Contact::ContactParameters         contact;
    TimeParameters                     time;
    StopParameters                     stop;
    OutputParameters                   output;
    MeasureParameters                  measures;
    RankParameters                     ranks;

    /// The complete parameters as a scene file that reproduces the run, with
    /// the catalogue's values written out: the content of used.prm.
    std::string used_parameters;
    /// Hash of used_parameters, see text_hash().
    std::string parameters_hash;
    /// Advice that reading gave: the run log prints it.
    std::vector<std::string> warnings;
  };
} // namespace Morsel::Scene

#endif
