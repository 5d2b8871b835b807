#ifndef morsel_sph_solid_h
#define morsel_sph_solid_h

#include <morsel/core/particle_edges.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/bonds.h>
#include <morsel/sph/cloud.h>
#include <morsel/sph/damage_evolution.h>
#include <morsel/sph/deformable_body.h>
#include <morsel/sph/granular.h>
#include <morsel/sph/host.h>
#include <morsel/sph/leapfrog.h>
#include <morsel/sph/normalisation.h>
#include <morsel/sph/pair_loops.h>
#include <morsel/sph/particles.h>

#include <memory>

namespace Morsel::SPH
{
  /// A body of particles: total Lagrangian, its gradients normalised or
  /// conforming as the scene asks, alike in strain and force, with damage and
  /// granular response where the scene asks for them.
  ///
  /// Call order of a step: compute_accelerations(), add_grain_forces(),
  /// apply_forces() for each contact, grow_damage(), advance(),
  /// advance_grains(). Sums (energies, momentum, counts) are over all ranks
  /// and collective.
  class Solid final : public DeformableBody
  {
  public:
    /// Fills the body's shape on the ranks of @p communicator, which share it
    /// by @p work, see ParticleHost. Particles that do not see each other past
    /// the body's cracks have no bond.
    Solid(const Scene::ParticleBody &body,
          const Scene::Scene        &scene,
          MPI_Comm                   communicator,
          CellWork                   work = {});

    /// The body's CFL factor times the largest stable step [s], with a
    /// contact of @p contact_stiffness [N/m] per particle. Collective.
    double
    stable_time_step(double contact_stiffness) const override;

    /// The same, but no more than what is stable where friction stops the
    /// share @p stopped of a particle's slip in every step [1]. Collective.
    double
    stable_time_step(double contact_stiffness, double stopped) const;

    /// The largest stable step of the body as it is, at rest [s], with its
    /// outermost particles on springs of @p contact_stiffness [N/m]: from its
    /// highest frequency as square_of_highest_frequency() finds it in the
    /// forces themselves, with the rule's viscosity. Before the first step;
    /// the state is what it was. Collective.
    double
    measured_stable_time_step(double contact_stiffness, double stopped);

    void
    compute_accelerations(double time_step) override;

    /// Forces of unbonded pairs; nothing where nothing has failed.
    void
    add_grain_forces(double time_step) override;

    void
    apply_forces(const std::vector<ParticleForce> &forces);

    /// Damage growth and broken bonds of this step.
    void
    grow_damage(double time_step) override;

    /// Leapfrog: half velocities and displacements.
    void
    advance(double time_step) override;

    /// Density and stress of the grains.
    void
    advance_grains(double time_step) override;

    /// Marks the particles in whose stress numerical tension is expected.
    void
    set_near_face(const std::vector<unsigned int> &near);

    /// Energies at the time of the last compute_accelerations().
    SolidEnergies
    energies() const override;

    /// Linear momentum at the last half step [kg m/s].
    Vector2
    momentum() const override;

    /// Cauchy stress that a particle carries [Pa].
    Materials::PlaneStrainStress
    stress(unsigned int i) const override;

    Materials::Tensor2
    velocity_gradient(unsigned int i) const override;

    std::vector<Vector2>
    surface_vectors() const override;

    double
    neighbours_per_particle() const override;

    Particles &
    state() override
    {
      return particles;
    }

    const Particles &
    get_particles() const override
    {
      return particles;
    }

    const Bonds &
    get_bonds() const
    {
      return bonds;
    }

    const Materials::Elasticity &
    get_material() const override
    {
      return material;
    }

    void
    exchange_state(StateArchive &state) override;

    /// Collective.
    ParticleSide
    contact_side() const;

    /// Of scattered particles.
    const ParticleEdges &
    get_edges() const
    {
      return edges;
    }

    bool
    can_fail() const
    {
      return fracture != nullptr;
    }

    double
    failed_share() const
    {
      return fracture ? fracture->failed_share() : 0.;
    }

    const ParticleHost<2> &
    get_host() const
    {
      return host;
    }

    const ParticleHost<2> *
    ranks() const override
    {
      return host.is_alone() ? nullptr : &host;
    }

    /// What a step takes for each of the owned particles, as modelled, in
    /// hundredths of a bonded one's.
    std::vector<unsigned int>
    work_of_particles() const;

    /// What to make the body anew takes, in steps of it, as modelled.
    double
    steps_to_set_up() const
    {
      return set_up;
    }

    bool
    has_viscosity() const
    {
      return viscosity;
    }

    /// Density over reference density [1].
    double
    density_ratio(unsigned int i) const override;

    /// Particles that are not finite or turned inside out.
    unsigned int
    inverted_count() const;

    /// None with the linear law, in which F is no measure of that.
    long
    first_inverted() const override;

  private:
    /// What has to be known of the whole body before ranks share it.
    struct Layout;

    Solid(const Scene::ParticleBody &body,
          const Scene::Scene        &scene,
          MPI_Comm                   communicator,
          CellWork                   work,
          const Layout              &layout);

    /// Waits for the motion of ghosts.
    void
    finish_motion();

    void
    fill(const Scene::ParticleBody &body,
         const Layout              &layout,
         unsigned int               seed);

    /// Moduli of the body's grains, if they differ.
    void
    scatter_modulus(const Scene::ParticleBody &body, unsigned int seed);

    /// Strength of each particle's grain over the body's [1]; empty if they
    /// do not differ.
    std::vector<double>
    strength_of_grains(const Scene::ParticleBody &body,
                       unsigned int               seed) const;

    /// Over all ranks: by no more does the square of a frequency grow, since
    /// the energy of each particle does not.
    double
    largest_modulus_factor() const;

    void
    allocate(const Scene::ParticleBody &body);

    void
    normalise(const Scene::ParticleBody &body);

    /// Volumes and edges of scattered particles.
    void
    take_cells(const Cloud &cloud);

    /// Of the undeformed body.
    double
    measured_highest_frequency();

    /// Rate at which viscosity damps, as far as the step goes [1/s].
    double
    damping_rate() const;

    void
    choose_loops(const Scene::ParticleBody &body);

    void
    make_breakable(const Scene::ParticleBody &body, const Scene::Scene &scene);

    const double                depth;
    const double                cfl;
    const Kernel                kernel;
    const Materials::Elasticity material;
    const bool                  linear_law;
    const Materials::Softening  softening;
    const double                hourglass_stiffness; ///< alpha E [Pa]
    const Normalisation         normalisation;

    ParticleHost<2> host;
    Particles       particles;
    Bonds           bonds;
    ParticleEdges   edges;
    bool            viscosity;
    Leapfrog        leapfrog;
    double          highest_frequency = 0.; ///< its square [1/s^2]
    double          set_up            = 0.; ///< [steps]

    BondedConstants     constants;
    BondedArrays        arrays{};
    PairKernels::Strain column_loop; ///< of bonds.lattice
    PairKernels::Strain strain_loop;
    PairKernels::Force  force_loop;
    PairKernels::Strain energy_loop = nullptr; ///< or by particles

    /// Ghosts' motion is on its way since advance().
    bool                          motion_travels = false;
    static constexpr unsigned int motion_channel = 1, stiffness_channel = 2,
                                  fit_channel = 3;

    std::unique_ptr<DamageEvolution> fracture;
    std::unique_ptr<Granular>        granular;
  };
} // namespace Morsel::SPH

#endif
