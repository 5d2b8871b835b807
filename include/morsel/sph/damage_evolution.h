#ifndef morsel_sph_damage_evolution_h
#define morsel_sph_damage_evolution_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/materials/flaws.h>
#include <morsel/sph/bonds.h>
#include <morsel/sph/host.h>
#include <morsel/sph/local_numbers.h>
#include <morsel/sph/pair_loops.h>
#include <morsel/sph/particles.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace Morsel::SPH
{
  /// Damage growth and the breaking of bonds of one body.
  ///
  /// A particle whose damage reaches one fails: its bonds are cut for good
  /// and it goes on as a grain (see Granular). A bond longer than the friend
  /// distance lives only as long as a chain of shorter live bonds connects
  /// its ends, so that bonds do not reach across a crack one row wide, and
  /// the pieces that live bonds hold together are exactly the fragments that
  /// friends-of-friends finds. On scattered particles some longer bonds have
  /// no such chain from the start: nothing lies between their ends, and they
  /// are as good as short ones.
  ///
  /// On several ranks the owner of a particle grows its damage and decides
  /// that it fails; all ranks that know the particle then cut its bonds. Of a
  /// longer bond the owners of its ends decide, and tell the others which they
  /// have cut until nobody cuts any more. Which bonds live in the end does not
  /// depend on the order: a bond that is cut never supports another again.
  class DamageEvolution
  {
  public:
    /// Allocates and fills the damage fields of @p particles.
    /// @param friend_distance [m].
    /// @param strength of each particle's grain over the body's [1]; empty
    ///   where it is uniform.
    /// @param ranks where the particles live, if on several ranks; @p bonds
    ///   then has rows of ghosts. Collective.
    DamageEvolution(Particles                         &particles,
                    Bonds                             &bonds,
                    const Kernel                      &kernel,
                    const Materials::Elasticity       &material,
                    bool                               linear_law,
                    const Materials::DamageLaw        &law,
                    const BondedConstants             &loop_constants,
                    const Materials::DamageParameters &parameters,
                    double                             friend_distance,
                    unsigned int                       seed,
                    const std::vector<double>         &strength = {},
                    const ParticleHost<2>             *ranks    = nullptr);

    /// Damage growth over one step from the present stress; then cuts the
    /// bonds of what has failed. Returns the owned particles that failed now.
    ///
    /// The step goes from the forces of before to those of after: the energy
    /// that work and motion see leave the body is the mean of what the change
    /// releases at the step's two ends, which is what the heats hold.
    const std::vector<unsigned int> &
    update(double time_step);

    /// Whether anything failed in the last update(), on any rank.
    bool
    any_failed_now() const
    {
      return failed_anywhere;
    }

    /// Energy released by the breaking of bonds so far [J]; what the cut
    /// itself changed, as opposed to damage growth before it. The part of this
    /// rank's particles.
    double
    bond_heat() const
    {
      return heat_of_bonds;
    }

    /// Length of the shortest bond that particle @p i had when it failed
    /// [m]; the spacing where it has not, or less across a crack.
    const std::vector<double> &
    contact_diameters() const
    {
      return contact_diameter;
    }

    /// Particles with at least one cut bond.
    const std::vector<char> &
    exposed_particles() const
    {
      return exposed;
    }

    /// Owned particles that lost bonds in the last update(), some more than
    /// once.
    const std::vector<unsigned int> &
    parted_now() const
    {
      return parted;
    }

    /// Of the whole body.
    double
    failed_share() const
    {
      return failed_area / total_area;
    }

    /// Adds what growth takes of each particle in a step, and takes away the
    /// bonded work of what has failed.
    /// @param of_particles in hundredths of what a bonded particle takes
    void
    add_work(std::vector<unsigned int> &of_particles) const;

    /// Without the fields of the particles.
    void
    exchange_state(StateArchive &state);

  private:
    /// Damage this close to one is failure: nothing measurable is left.
    static constexpr double failure_damage = 0.999;

    /// A particle that loses bonds.
    struct Touched
    {
      unsigned int particle;
      double       energy_before; ///< mean_energy() with all its bonds [J]
      Materials::Tensor2 gradient_before; ///< then, with them [1]
    };

    /// A particle's gradient H [1], its response and the residual of its fit
    /// (see fit_residual()) [m^3] now and at the end of the coming step.
    struct Ends
    {
      Materials::Tensor2         gradient[2];
      Materials::ElasticResponse response[2];
      double                     residual[2];
    };

    void
    find_groups_nearby();

    void
    find_direct_bonds();

    /// Particles that face each other across a crack touch as they are.
    void
    measure_cracks();

    bool
    may_grow(unsigned int group) const;

    void
    grow(const BondedArrays &arrays, unsigned int group);

    /// Least strength that a live particle of a group is left with [1].
    double
    weakest_in(unsigned int group) const;

    /// Energy softening of the particles of a group that are not crushed,
    /// under these undamaged stresses.
    void
    soften_group(const BondedArrays   &arrays,
                 unsigned int          group,
                 const AveragedStress &stress);

    /// The same of particle @p i, whatever its gradient and its softening.
    void
    soften(unsigned int i, const Materials::PlaneStrainStress &stress);

    bool
    is_crushed(unsigned int i) const;

    /// Each particle's own stress and its driver, not averaged.
    void
    take_own_stress(unsigned int group, AveragedStress &stress) const;

    void
    break_up();

    /// Makes those that wait to fail the batch that fails next, on all ranks.
    /// @return whether there are any, anywhere
    bool
    take_batch();

    bool
    take_batch_of_all_ranks();

    /// Leaves groups out of the loops of which all particles have failed.
    void
    retire_group(unsigned int group);

    /// @name What growth needs of the ghosts.
    ///@{
    void
    exchange_ghosts_start();

    void
    exchange_ghosts_finish();
    ///@}

    /// Bounds of the averages that ghosts take part in.
    void
    bound_ghosts();

    /// Cuts what other ranks have cut, and what has lost its support by that.
    void
    agree_on_cuts();

    void
    release_damage(unsigned int i, double new_damage);

    void
    release_damage(unsigned int i, const Ends &ends, double new_damage);

    void
    set_damage(unsigned int i, double new_damage);

    /// As its bonds are; at the end with the gradient that it had before cuts
    /// if it is to fail now, since its bonds do not span the plane.
    Ends
    ends_of(unsigned int i) const;

    Ends
    ends_at(const Materials::Tensor2 &now,
            const Materials::Tensor2 &then) const;

    /// Energy of particle i with this damage [J], the mean of both ends.
    double
    mean_energy(unsigned int i, const Ends &ends, double damage) const;

    double
    mean_energy(const unsigned int i) const
    {
      return mean_energy(i, ends_of(i), particles.damage[i]);
    }

    void
    fail(unsigned int i);

    /// Cuts longer bonds of the suspects until all have their chains.
    void
    clear_suspects();

    void
    cut_unsupported(unsigned int i);

    void
    cut(unsigned int k, unsigned int i);

    void
    touch(unsigned int i);

    bool
    supported(unsigned int i, unsigned int k) const;

    void
    settle_touched();

    Particles                  &particles;
    Bonds                      &bonds;
    const Materials::Elasticity material;
    const bool                  linear_law;
    const Materials::DamageLaw  law;
    const BondedConstants       constants;
    const PairKernels::Strain   own_driver;
    const PairKernels::Average  average_driver;
    /// Null where particles soften one by one or otherwise.
    const PairKernels::Soften soften_lanes;
    const bool                average_stress;
    const double              friend_distance_square;
    const double              hourglass_stiffness;
    const std::vector<double> strength; ///< of grains, or empty [1]
    /// Where each flaw is followed on its own.
    std::unique_ptr<const Materials::ExplicitFlaws> flaws;

    const ParticleHost<2> *const ranks; ///< null where there is but one
    const LocalNumbers           local; ///< of all particles, on several

    std::vector<unsigned int> newly_failed, failed_now, suspects, parted;
    std::vector<unsigned int> batch; ///< that fails now, owned and ghosts
    bool                      failed_anywhere = false;
    std::vector<Touched>      touched;
    /// Ends of longer bonds that this rank has cut and others know.
    std::vector<std::array<unsigned long long, 2>> cut_pairs;
    std::map<unsigned int, Materials::Tensor2>     gradient_of_doomed;
    std::vector<char>                              is_touched, exposed;
    std::vector<char>   is_direct; ///< entries of bonds
    std::vector<double> contact_diameter;
    double              time_step     = 0.; ///< the coming one [s]
    double              heat_of_bonds = 0.; ///< of the owned particles [J]
    double              failed_area   = 0.; ///< on all ranks [m^2]
    const double        total_area;

    // For each group of particles.
    NeighbourList       groups_nearby;
    std::vector<double> weakest_of_group;
    std::vector<char>   any_full; ///< holds damage that means failure
  };
} // namespace Morsel::SPH

#endif
