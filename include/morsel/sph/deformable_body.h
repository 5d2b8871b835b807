#ifndef morsel_sph_deformable_body_h
#define morsel_sph_deformable_body_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/materials/elasticity.h>
#include <morsel/sph/particles.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <vector>

namespace Morsel::SPH
{
  template <int dim>
  class ParticleHost;


  /// Energies of one body [J].
  struct SolidEnergies
  {
    double strain        = 0.; ///< recoverable, of live particles
    double hourglass     = 0.; ///< of the residual of the linear fit
    double kinetic       = 0.;
    double granular      = 0.; ///< recoverable, of grains and pairs
    double damage_heat   = 0.;
    double bond_heat     = 0.;
    double viscous_heat  = 0.;
    double friction_heat = 0.;
    double artificial    = 0.; ///< work taken by the artificial stress
  };


  /// A body of particles in whatever formulation: what loads, supports and
  /// measures need to know of it. A step is compute_accelerations(), forces
  /// from outside added to the particles' accelerations, advance().
  class DeformableBody
  {
  public:
    virtual ~DeformableBody() = default;

    /// The body's CFL factor times the largest stable step [s], with a
    /// contact of @p contact_stiffness [N/m] per particle.
    virtual double
    stable_time_step(double contact_stiffness) const = 0;

    virtual void
    compute_accelerations(double time_step) = 0;

    /// @name What a solid that can fail does besides.
    ///@{
    /// Forces of unbonded pairs, after compute_accelerations().
    virtual void
    add_grain_forces(double /*time_step*/)
    {}

    /// Damage growth and broken bonds of this step, before advance().
    virtual void
    grow_damage(double /*time_step*/)
    {}

    /// Density and stress of the grains, after advance().
    virtual void
    advance_grains(double /*time_step*/)
    {}
    ///@}

    /// Leapfrog: velocities to the next half step, the rest to the next step.
    virtual void
    advance(double time_step) = 0;

    /// Energies at the time of the last compute_accelerations().
    virtual SolidEnergies
    energies() const = 0;

    /// Linear momentum at the last half step [kg m/s].
    virtual Vector2
    momentum() const = 0;

    /// Cauchy stress that a particle carries [Pa].
    virtual Materials::PlaneStrainStress
    stress(unsigned int i) const = 0;

    /// Density over reference density [1].
    virtual double
    density_ratio(unsigned int i) const = 0;

    /// A particle of this rank that is turned inside out but has not failed, or
    /// -1.
    virtual long
    first_inverted() const = 0;

    /// Gradient of the present velocities as the body's strain sees it [1/s].
    virtual Materials::Tensor2
    velocity_gradient(unsigned int i) const = 0;

    /// Surface vector of each particle in the reference configuration, S_i =
    /// -V_i sum_j V_j (B_i + B_j) grad W_ij [m^2]: a constant stress sigma
    /// makes the force -sigma S_i, so that tractions given out as sigma S_i
    /// are the ones which a constant stress balances. Of the owned particles;
    /// collective.
    virtual std::vector<Vector2>
    surface_vectors() const = 0;

    /// Pairs per particle [1].
    virtual double
    neighbours_per_particle() const = 0;

    /// For forces and prescribed motion.
    virtual Particles &
    state() = 0;

    virtual const Particles &
    get_particles() const = 0;

    virtual const Materials::Elasticity &
    get_material() const = 0;

    /// Where the particles live if several ranks share them, else null.
    virtual const ParticleHost<2> *
    ranks() const
    {
      return nullptr;
    }

    /// @name Over all ranks, the array in place; collective.
    ///@{
    double
    sum_over_ranks(double part) const;

    void
    sum_over_ranks(const dealii::ArrayView<double> &parts) const;
    ///@}

    /// Saves or loads what changes from step to step, between advance() and
    /// the next compute_accelerations().
    virtual void
    exchange_state(StateArchive &state) = 0;

    /// Of the owned particles [Pa]; empty where all have the material's.
    std::vector<double>
    youngs_moduli() const
    {
      const Particles    &p = get_particles();
      std::vector<double> result;
      if (!p.modulus.empty())
        for (unsigned int i = 0; i < p.n_owned; ++i)
          result.push_back(p.modulus[i] * get_material().youngs_modulus);
      return result;
    }
  };


  /// Of all bodies at their last half steps [kg m/s].
  template <typename Body>
  dealii::Tensor<1, 2>
  total_momentum(const std::vector<std::unique_ptr<Body>> &bodies)
  {
    dealii::Tensor<1, 2> sum;
    for (const auto &body : bodies)
      {
        const Vector2 p = body->momentum();
        sum += dealii::Tensor<1, 2>({p.x, p.y});
      }
    return sum;
  }
} // namespace Morsel::SPH

#endif
