#ifndef morsel_sph_granular_h
#define morsel_sph_granular_h

#include <morsel/core/kernel.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/materials/elasticity.h>
#include <morsel/sph/bonds.h>
#include <morsel/sph/host.h>
#include <morsel/sph/local_numbers.h>
#include <morsel/sph/member_exchange.h>
#include <morsel/sph/pair_kernels.h>
#include <morsel/sph/particles.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <memory>
#include <vector>

namespace Morsel::SPH
{
  /// Constants of the granular response.
  struct GranularConstants
  {
    double friction;          ///< sqrt(J2) <= friction * pressure [1]
    double viscosity_alpha;   ///< T3-44 [1]
    double viscosity_beta;    ///< T3-44 [1]
    double contact_stiffness; ///< of two particles that touch [N/m]
  };


  /// What becomes of failed material, and of the surfaces that breaking has
  /// laid bare: pairs that no bond holds (any more).
  ///
  /// A failed particle is a grain of an updated Lagrangian granular material:
  /// density by continuity from what it was at failure, pressure by the same
  /// law as the solid's and never below zero, a deviator by the Jaumann rate
  /// under a Drucker-Prager cap. Against live particles the pair force is
  /// that of its stress alone, counted twice, so that it hands over the full
  /// traction, and so is the pair's part of its velocity gradient: power and
  /// energy agree. Unbonded particles that come closer than their contact
  /// diameter repel each other by a penalty; live ones rub with Coulomb
  /// friction.
  ///
  /// Grains move far from where the reference configuration had them: on
  /// several ranks the pairs across ranks are found by present positions. Each
  /// rank computes the forces on its own particles, both ranks of a pair from
  /// the same numbers.
  class Granular
  {
  public:
    /// @param ranks where the particles live, if on several ranks
    Granular(Particles                   &particles,
             const Bonds                 &bonds,
             const Kernel                &kernel,
             const Materials::Elasticity &material,
             const GranularConstants     &constants,
             const std::vector<char>     &exposed,
             const std::vector<double>   &contact_diameters,
             const ParticleHost<2>       *ranks = nullptr);

    /// Takes over this rank's particles of those that have just failed, on
    /// this rank or another: density ratio from their deformation gradient, no
    /// deviator.
    /// @param parted this rank's particles that have lost bonds, those that
    ///   failed among them
    void
    take_over(const std::vector<unsigned int> &failed,
              const std::vector<unsigned int> &parted);

    /// Advances density and deviator by one step; positions are at the new
    /// time, half_velocity at the middle of the step.
    void
    advance(double time_step);

    /// Adds the accelerations of all unbonded pairs at the present positions.
    void
    add_forces(double time_step);

    bool
    active() const
    {
      return any_failed;
    }

    /// Recoverable energy of this rank's grains and of its part of penalty
    /// contacts [J].
    double
    stored_energy() const;

    /// Energy turned into heat so far [J] by grain friction and by surface
    /// friction of unbonded pairs, this rank's part.
    double
    friction_heat() const;

    /// Cauchy stress of a failed particle [Pa].
    Materials::PlaneStrainStress
    stress(unsigned int i) const;

    /// Density over reference density [1].
    double
    density_ratio(const unsigned int i) const
    {
      return ratio[i];
    }

    /// Adds what the unbonded pairs of each particle take in a step.
    /// @param of_particles in hundredths of what a bonded particle takes
    void
    add_work(std::vector<unsigned int> &of_particles) const;

    void
    exchange_state(StateArchive &state);

  private:
    static constexpr unsigned int nobody = -1;

    /// So many members may join before the list is built anew.
    static constexpr unsigned int most_joining = 128;

    /// Other ranks' members stand behind those that may join.
    unsigned int
    first_foreign() const
    {
      return n_in_grid + most_joining;
    }

    /// Members that are worked on together.
    static constexpr unsigned int block_size = 64;

    /// The unbonded pairs of some members; entries count members.
    struct Block
    {
      unsigned int first, last; ///< members [first, last)
      unsigned int n_rows, n_grains;
      /// Pairs with a grain as GrainArrays has them.
      std::vector<unsigned int> row, slot_begin, grain_pair;
      /// Of each member with live ones.
      std::vector<unsigned int> live_start, live_pair;
    };

    /// The pairs of each member of a block that is being filled.
    struct PairsOfMembers
    {
      std::array<std::vector<unsigned int>, block_size> grain;
      std::vector<unsigned int>                         live;
    };

    /// What does not change of a member of another rank between two searches.
    struct Foreign
    {
      unsigned long long id;
      dealii::Point<2>   place; ///< when the list was built [m]
      GrainSize          size;
      double             mass;
      double             allowance; ///< [m]
      unsigned long long failed;    ///< so wide: no byte is left to chance
    };

    /// Finds the unbonded pairs that can come near each other before any
    /// member has moved further than its allowance, which goes with its speed.
    void
    rebuild_list(double time_step);

    /// Lets what has changed since the list was built join it, where that is
    /// little and no other rank's business. @return whether it is
    bool
    amend_list(double time_step);

    /// Whether what has changed may have pairs with other ranks' members.
    bool
    change_concerns_others() const;

    void
    number_members();

    /// Appends blocks of the members from @p first on, which are not filled.
    void
    add_blocks(unsigned int first);

    /// Fills those of the blocks that @p is_meant says.
    template <typename Predicate>
    void
    fill_blocks(const Predicate &is_meant);

    /// How far a member may move until the list is built anew [m].
    double
    allowance_of(unsigned int i, double time_step) const;

    /// Of contact and mass.
    GrainSize
    member_size(unsigned int m) const;

    /// Members of other ranks near those of this one, and who is near whom.
    /// @param reach no pair that is listed is further apart [m]
    void
    find_foreign(double reach);

    void
    fill_block(Block &block) const;

    /// Adds the pair of member @p m of @p block with member @p n at distance^2
    /// @p r2 where it is to be listed.
    void
    add_pair(const Block    &block,
             PairsOfMembers &pairs,
             unsigned int    m,
             unsigned int    n,
             double          r2) const;

    /// Lays the pairs with a grain out as the kernels read them.
    void
    lay_out(Block &block, const PairsOfMembers &pairs) const;

    GrainArrays
    rows_of(const Block &block) const;

    /// No bond holds these members together.
    bool
    unbonded(unsigned int m, unsigned int n) const;

    /// Positions, velocities and stress of the members at the present time.
    void
    gather_state();

    /// @name The same of other ranks' members.
    ///@{
    void
    exchange_state_of_members();

    void
    exchange_rates_of_members();
    ///@}

    /// Their positions and velocities at the middle of the step.
    /// @return whether one of this rank's has moved further than it may
    bool
    gather_rates(double time_step);

    void
    advance_grain(unsigned int              i,
                  const Materials::Tensor2 &rate,
                  double                    time_step);

    void
    push(const Block &block, double time_step);

    /// Contact and friction of the surfaces of live material.
    void
    push_live(const Block &block,
              unsigned int member,
              double       time_step,
              GrainForce  &sum,
              double      &rubbed) const;

    double
    grain_energy(unsigned int i) const;

    Particles                  &particles;
    const Bonds                &bonds;
    const Kernel                kernel;
    const Materials::Elasticity material;
    const GranularConstants     constants;
    const std::vector<char>    &exposed;
    const std::vector<double>  &contact_diameter;

    const PairKernels           &kernels;
    const GrainConstants         loop_constants;
    const PairKernels::GrainPush force_loop;
    const PairKernels::GrainRate rate_loop;

    std::vector<char>       on_surface; ///< of the intact body
    std::vector<double>     ratio;      ///< rho / rho_0 [1]
    std::vector<Symmetric2> deviator;   ///< in plane, of the grains [Pa]
    std::vector<double>     energy;     ///< recoverable, of the grains [J]
    std::vector<double>     grain_heat, pair_friction_heat;
    std::vector<double>     penalty_energy;

    const ParticleHost<2> *const    ranks; ///< null where there is but one
    const LocalNumbers              local; ///< of all particles, on several
    std::unique_ptr<MemberExchange> exchange;

    // Unbonded pairs near each other, rebuilt when anything has moved far.
    // Members stand cell by cell, followed by those that have joined, by those
    // of other ranks, and by a far dummy that fills up rows.
    std::vector<unsigned int>     members;
    std::vector<unsigned int>     number; ///< of each particle, or nobody
    unsigned int                  n_in_grid = 0; ///< which do stand so
    unsigned int                  dummy     = 0;
    std::vector<unsigned int>     changed; ///< particles not yet listed as are
    std::vector<Foreign>          foreign;
    NeighbourList                 foreign_near; ///< of each of those in cells
    double                        travelled_at_build = 0.; ///< see Particles
    std::vector<char>             member_failed;
    std::vector<dealii::Point<2>> built_at;
    std::vector<double>           allowance; ///< also of other ranks' [m]
    double                        longest_allowance = 0.; ///< [m]
    std::vector<Block>            blocks;
    CellGrid                      grid;
    bool                          any_failed = false;
    bool                          stale      = true;

    // State of the members, gathered once per step for all of their pairs.
    dealii::AlignedVector<GrainMotion> motion;
    dealii::AlignedVector<GrainStress> member_stress;
    dealii::AlignedVector<GrainSize>   size;
    dealii::AlignedVector<double>      area, mass;
  };
} // namespace Morsel::SPH

#endif
