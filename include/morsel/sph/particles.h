#ifndef morsel_sph_particles_h
#define morsel_sph_particles_h

#include <morsel/core/records.h>
#include <morsel/materials/elasticity.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Morsel::SPH
{
  /// What the second loop gathers: P B - k_hg H / 2 [Pa].
  struct alignas(32) PairStress
  {
    double xx, xy, yx, yy;
  };


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
    std::vector<PairStress>         pair_stress;
    std::vector<double>             hourglass; ///< alpha E (1 - D) [Pa]

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

    dealii::Point<2>
    position(const unsigned int i) const
    {
      return {reference[i][0] + motion[i].u_x, reference[i][1] + motion[i].u_y};
    }
  };
} // namespace Morsel::SPH

#endif
