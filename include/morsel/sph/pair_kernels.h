#ifndef morsel_sph_pair_kernels_h
#define morsel_sph_pair_kernels_h

#include <morsel/core/records.h>
#include <morsel/materials/elasticity.h>

namespace Morsel::SPH
{
  /// What the second loop gathers [Pa]: P B - k_hg H / 2; in the conforming
  /// form P, and beside it P R^T C - k_hg H_fit / 2.
  struct alignas(32) PairStress
  {
    double xx, xy, yx, yy;
  };


  /// Particles are worked on in groups of this many, whatever the width of
  /// the machine's vectors.
  constexpr unsigned int group_size = 8;


  /// What a group of particles stores [J].
  struct GroupEnergy
  {
    double strain, hourglass;
  };


  /// What lattice groups read of their neighbours in columns: displacement [m],
  /// velocity [m/s] and PairStress [Pa].
  enum LatticeColumn : unsigned int
  {
    column_u_x,
    column_u_y,
    column_v_x,
    column_v_y,
    column_xx,
    column_xy,
    column_yx,
    column_yy,
    n_lattice_columns
  };


  /// How a group of particles is worked on, and in what form its neighbours
  /// read what it writes; see LatticeGroups.
  enum LatticeUse : char
  {
    lattice_regular       = 1, ///< by the pattern
    lattice_needs_records = 2,
    lattice_needs_columns = 4,
    lattice_frayed        = 8 ///< by the pattern, with weights of its own
  };


  /// Addresses of LatticeGroups. Pairs come in twos, X and -X.
  struct LatticeArrays
  {
    unsigned int n_twos;
    const char  *use; ///< of each group, or null where none is regular
    /// Of each group, two for each two: the neighbours at X and at -X of its
    /// first particle; those of the next ones follow.
    const unsigned int *first;
    const double       *x, *y;                        ///< X [m]
    const double       *weight, *weight_x, *weight_y; ///< a, a X
    Symmetric2          shape;
    double             *column[n_lattice_columns];
  };


  /// Plain addresses of what the kernels of bonded particles read and write;
  /// see Particles and PackedBonds. No class with code of its own passes into
  /// a kernel: an inline function compiled for one machine must not be the
  /// one that the linker keeps for all.
  struct BondedArrays
  {
    const unsigned int *slot_begin, *slot_end; ///< of each group
    const unsigned int *near_end;              ///< of the slots with a weight
    const double       *weight, *dx, *dy, *average;
    const unsigned int *index;

    unsigned int                  n_owned;
    const double                 *reference; ///< X, two of each [m]
    const Motion                 *motion;
    const Symmetric2             *shape;
    const double                 *hourglass, *damage;
    const char                   *near_face;
    Materials::Tensor2           *gradient;
    PairStress                   *pair_stress;
    Materials::PlaneStrainStress *effective;
    Vector2                      *acceleration;
    Vector2                      *viscous; ///< acceleration by viscosity
    double                       *driver;
    char                         *crushed;
    double                       *strongest; ///< of each group
    const Symmetric2 *fit; ///< least-squares matrix where shape is another one
    const double     *mass;

    // Of the conforming gradient, per pair and per particle.
    const double             *own_x, *own_y;   ///< G_ij
    const double             *back_x, *back_y; ///< V_j/V_i G_ji
    const double             *damping;         ///< weight of viscosity
    const Vector2            *own_sum;         ///< sum_j G_ij
    const Materials::Tensor2 *deficit;
    PairStress               *fit_stress;

    const double *modulus; ///< over the body's [1]; null where it is uniform
    const char   *failed;
    GroupEnergy  *energy; ///< of each group

    LatticeArrays lattice;
  };


  /// Constants of the kernels of bonded particles.
  struct BondedConstants
  {
    double mu, bulk; ///< [Pa]
    double density;
    double uniform_hourglass; ///< where no particle can soften [Pa]
    double viscosity_alpha_c; ///< alpha times the wave speed [m/s]
    double viscosity_beta, smoothing_length;
    double crushed_jacobian;

    // Drivers of damage, see Materials::driver_value().
    double von_mises_d, von_mises_P, tensile_strength;
    double poissons_ratio, youngs_modulus, extension_scale;
    double average_self; ///< weight of the particle itself [1/m^2]
  };


  /// A particle of the list of unbonded pairs at one time.
  struct alignas(32) GrainMotion
  {
    double x, y, v_x, v_y;
  };


  /// Cauchy stress in the plane and current area, negative for a particle
  /// that is not a grain (whose stress is zero here).
  struct alignas(32) GrainStress
  {
    double xx, yy, xy, signed_area;
  };


  /// Sums over the pairs of one member.
  struct GrainForce
  {
    double x, y, viscous_x, viscous_y, pressed;
  };


  /// What does not change of a particle of that list.
  struct GrainSize
  {
    double diameter; ///< of contact [m]
    double area;     ///< in the reference configuration [m^2]
  };


  /// The pairs with a grain of a few members, the rows: those that are grains
  /// first. Slot s of a group of rows holds one pair of each; rows with fewer
  /// pairs than the group's longest end in pairs with a far dummy.
  struct GrainArrays
  {
    const unsigned int *row;        ///< members, filled up to a whole group
    const unsigned int *slot_begin; ///< of each group and past the last
    const unsigned int *index;      ///< members, group_size a slot
    unsigned int        n_rows, n_grains;
    unsigned int        first_row; ///< the member of the first sum
    const GrainMotion  *motion;
    const GrainStress  *stress; ///< forces alone
    const GrainSize    *size;   ///< forces alone
    const double       *mass;   ///< forces alone [kg]
    const double       *area;   ///< rates alone: present one [m^2]
  };


  struct GrainConstants
  {
    double h, normalisation, support_square;
    double thickness;      ///< of the plane [m]
    double contact_square; ///< no contact diameter exceeds its root [m^2]
    double viscosity_alpha_c, viscosity_beta, contact_stiffness;
  };


  /// Stress averaged over the neighbours of each particle of a group [Pa],
  /// and its driver [1].
  struct AveragedStress
  {
    double driver[group_size], xx[group_size], yy[group_size], xy[group_size],
        zz[group_size];

    Materials::PlaneStrainStress
    stress(const unsigned int l) const
    {
      return {xx[l], yy[l], xy[l], zz[l]};
    }
  };


  /// Energy softening of the particles of a group, see
  /// Materials::energy_softening().
  struct GroupSoftening
  {
    const Vector2 *half_velocity;         ///< of all particles [m/s]
    double         time_step;             ///< the coming one [s]
    double         threshold[group_size]; ///< [1]
    /// DamageLaw::range_at(), or 0 for particles that take no part [1].
    double range[group_size];
    double used[group_size]; ///< of the strength [1], before and after

    double damage[group_size]; ///< after it [1]
    /// Of those that soften: what a damage of one takes away, the mean of now
    /// and the end of the coming step [J].
    double released[group_size];
  };


  /// The kernels of one instruction set. Ranges count groups.
  struct PairKernels
  {
    using Strain    = void (*)(const BondedArrays    &arrays,
                            const BondedConstants &constants,
                            unsigned int           begin,
                            unsigned int           end);
    using Force     = void (*)(const BondedArrays    &arrays,
                           const BondedConstants &constants,
                           unsigned int           begin,
                           unsigned int           end);
    using Average   = void (*)(const BondedArrays    &arrays,
                             const BondedConstants &constants,
                             unsigned int           group,
                             AveragedStress        &average);
    using Soften    = bool (*)(const BondedArrays    &arrays,
                            const BondedConstants &constants,
                            unsigned int           group,
                            const AveragedStress  &average,
                            GroupSoftening        &state);
    using GrainPush = void (*)(const GrainArrays    &arrays,
                               const GrainConstants &constants,
                               GrainForce           *sums);
    using GrainRate = void (*)(const GrainArrays    &arrays,
                               const GrainConstants &constants,
                               Materials::Tensor2   *sums);

    const char  *name;
    unsigned int lanes;
    /// [viscosity]: brings what the other kernels need of the motion of lattice
    /// groups into columns; before those, where any group is regular.
    Strain columns[2];
    /// [linear law][no damage, softened deviator, softened principal].
    Strain strain[2][3];
    /// [linear law]: undamaged, with a gradient that is not the
    /// least-squares fit.
    Strain strain_own_fit[2];
    /// [linear law][no damage, softened deviator, softened principal]: of the
    /// conforming gradient.
    Strain strain_conforming[2][3];
    /// [linear law][no damage, softened deviator]: see energy_kernels.h.
    Strain energy[2][2];
    /// [viscosity][hourglass stiffness that varies].
    Force force[2][2];
    /// The same with the conforming gradient.
    Force force_conforming[2][2];
    /// [driver]: of each particle's own stress with the tensile cut-off.
    Strain own_driver[3];
    /// [driver]: of the average over the neighbours, for one group.
    Average average_driver[3];
    /// [driver][linear law]: see softening_kernels.h.
    Soften soften[3][2];
    /// [Wendland C2].
    GrainPush grain_force[2];
    GrainRate grain_rate[2];
  };


  /// The kernels for the widest vectors that this machine has.
  const PairKernels &
  pair_kernels();
} // namespace Morsel::SPH

#endif
