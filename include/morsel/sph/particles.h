#ifndef morsel_sph_particles_h
#define morsel_sph_particles_h

#include <morsel/core/records.h>
#include <morsel/materials/elasticity.h>
#include <morsel/sph/pair_kernels.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Morsel::SPH
{
  /// State of all particles of one body that this rank knows: first the
  /// owned ones, then the ghosts. Structure of arrays.
  struct Particles
  {
    unsigned int n_owned = 0;
    unsigned int n_local = 0;
    double       spacing = 0.; ///< dp [m]
    double       volume  = 0.; ///< V0 of one particle [m^3]
    double       mass    = 0.; ///< of one particle [kg]

    std::vector<dealii::Point<2>>   reference; ///< X [m]
    std::vector<unsigned long long> id;        ///< global index

    /// u_n and the velocity at the same time, v_n, predicted from the half
    /// step; rates that lag would make leapfrog forward Euler.
    std::vector<Motion>  motion;
    std::vector<Vector2> half_velocity; ///< v_{n-1/2} [m/s], owned
    std::vector<Vector2> acceleration;  ///< [m/s^2], owned

    std::vector<Materials::Tensor2> gradient; ///< H = F - I [1], owned
    std::vector<Symmetric2>         shape;    ///< B [1], owned
    /// (sum_j a_ij X_ij (x) X_ij)^-1 [1], owned; allocated only where the shape
    /// is another matrix.
    std::vector<Symmetric2> fit;
    std::vector<PairStress> pair_stress;
    std::vector<double>     hourglass; ///< alpha E (1 - D) [Pa]

    /// Energy turned into heat by artificial viscosity so far [J], owned;
    /// allocated only with viscosity.
    std::vector<double> viscous_heat;

    // Allocated only for a solid that can fail.
    std::vector<double> damage;    ///< D [1]
    std::vector<char>   failed;    ///< D = 1: no bond left
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
  };
} // namespace Morsel::SPH

#endif
