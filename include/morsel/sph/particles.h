#ifndef morsel_sph_particles_h
#define morsel_sph_particles_h

#include <morsel/core/records.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/materials/elasticity.h>
#include <morsel/sph/pair_kernels.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace Morsel::SPH
{
  /// What all particles of this rank have of a quantity.
  inline double
  sum_of(const std::vector<double> &quantity)
  {
    return std::accumulate(quantity.begin(), quantity.end(), 0.);
  }


  /// State of all particles of one body that this rank knows: first the
  /// owned ones, then the ghosts. Structure of arrays.
  struct Particles
  {
    unsigned int n_owned = 0;
    unsigned int n_local = 0;
    double       spacing = 0.; ///< dp [m]
    double       depth   = 0.; ///< out of plane [m]
    /// Way that the owned ones have gone at most, step by step the fastest
    /// [m]: what they move by since some time is no more than its change.
    double travelled = 0.;

    std::vector<double> area; ///< of each in the reference plane [m^2]
    std::vector<double> mass; ///< [kg]

    std::vector<dealii::Point<2>>   reference; ///< X [m]
    std::vector<unsigned long long> id;        ///< global index

    /// u_n and the velocity at the same time, v_n, predicted from the half
    /// step; rates that lag would make leapfrog forward Euler.
    std::vector<Motion>  motion;
    std::vector<Vector2> half_velocity; ///< v_{n-1/2} [m/s], owned
    std::vector<Vector2> acceleration;  ///< [m/s^2], owned

    std::vector<Materials::Tensor2> gradient; ///< H = F - I [1], owned
    /// B [1], owned; not allocated with the conforming gradient.
    std::vector<Symmetric2> shape;
    /// (sum_j a_ij X_ij (x) X_ij)^-1 [1], owned; allocated only where the shape
    /// is another matrix.
    std::vector<Symmetric2> fit;
    /// R = I - sum_j X_ij (x) G_ij [1], owned: what cut bonds took of the
    /// conforming gradient; allocated only for a solid that can fail.
    std::vector<Materials::Tensor2> deficit;
    /// sum_j G_ij of the uncut bonds [1/m], owned; only with the conforming
    /// gradient.
    std::vector<Vector2>    own_sum;
    std::vector<PairStress> pair_stress;
    /// What the conforming form gathers besides, see bonded_kernels.h.
    std::vector<PairStress> fit_stress;
    std::vector<double>     hourglass; ///< alpha E (1 - D) [Pa]

    /// Elastic moduli over the body's [1]; allocated only where they scatter
    /// from grain to grain (Materials::GrainField).
    std::vector<double> modulus;

    /// Of each group of particles, as far as kernels sum it; not state.
    std::vector<GroupEnergy> energy;

    // Owned, allocated only with viscosity or for a solid that can fail.
    std::vector<Vector2> viscous; ///< acceleration by viscosity [m/s^2]
    /// Energy that it turned into heat until the last half step [J].
    std::vector<double> viscous_heat;

    // Allocated only for a solid that can fail.
    std::vector<double> damage;    ///< D [1]
    std::vector<char>   failed;    ///< D = 1: no bond left
    std::vector<double> used;      ///< share of what it can dissipate [1]
    std::vector<double> threshold; ///< r_i: damage starts beyond it [1]
    std::vector<Materials::PlaneStrainStress> effective; ///< undamaged [Pa]
    std::vector<double> driver;      ///< s of the particle's own stress [1]
    std::vector<char>   near_face;   ///< within reach of a loaded face
    std::vector<double> damage_heat; ///< energy released so far [J]

    // The same, for each group of particles.
    std::vector<char>   crushed;   ///< holds a particle pressed too far
    std::vector<double> strongest; ///< largest driver [1]

    unsigned int
    n_groups() const
    {
      return (n_owned + group_size - 1) / group_size;
    }

    /// V_0 [m^3].
    double
    volume(const unsigned int i) const
    {
      return area[i] * depth;
    }

    /// Elastic moduli of a particle over the body's [1].
    double
    modulus_factor(const unsigned int i) const
    {
      return modulus.empty() ? 1. : modulus[i];
    }

    double
    sum_of_owned(const std::vector<double> &quantity) const
    {
      return std::accumulate(quantity.begin(), quantity.begin() + n_owned, 0.);
    }

    double
    least_mass() const
    {
      return *std::min_element(mass.begin(), mass.end());
    }

    /// Reference areas [m^2] of all particles, and what follows from them.
    void
    set_areas(std::vector<double> areas,
              const double        thickness,
              const double        density)
    {
      area  = std::move(areas);
      depth = thickness;
      mass.resize(area.size());
      for (unsigned int i = 0; i < mass.size(); ++i)
        mass[i] = density * volume(i);
    }

    /// Sets the velocities at time 0 [m/s], from the reference positions.
    template <typename Function>
    void
    set_velocity(const Function &velocity)
    {
      motion.resize(n_local);
      half_velocity.resize(n_local);
      for (unsigned int i = 0; i < n_local; ++i)
        {
          const dealii::Tensor<1, 2> v = velocity(reference[i]);
          motion[i]                    = {0., 0., v[0], v[1]};
          half_velocity[i]             = {v[0], v[1]};
        }
    }

    dealii::Point<2>
    position(const unsigned int i) const
    {
      return {reference[i][0] + motion[i].u_x, reference[i][1] + motion[i].u_y};
    }

    /// All fields that change from step to step.
    void
    exchange_state(StateArchive &state);

    /// The same of a solid that cannot fail: what its forces do not follow
    /// from is its motion.
    void
    exchange_motion(StateArchive &state);
  };
} // namespace Morsel::SPH

#endif
