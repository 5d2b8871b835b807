#ifndef morsel_jaw_dynamic_deformation_h
#define morsel_jaw_dynamic_deformation_h

#include <morsel/jaw/deformation.h>

#include <deal.II/base/mpi.h>

namespace Morsel::Jaw
{
  /// An elastic body with inertia, implicit in its own stiffness by Newmark's
  /// method (average acceleration for beta = 1/4) and explicit in the contact
  /// forces (Hughes and Liu 1978): with u at whole and v at half steps
  ///   M (u+ - 2 u + u-)/dt^2 + K (b u+ + (1 - 2 b) u + b u-) = f(u),
  /// which is leapfrog, as for the particles, with M + b dt^2 K in place of
  /// the mass. So body and food exchange the same impulse at the same
  /// moment, the energy of their contact is kept as well as among particles,
  /// and the step is limited by contact_frequency() alone: 4/dt^2 (M + b dt^2
  /// K) > K + K_contact. For b = 1/4 the body's stiffness drops out of that,
  /// for more it helps to carry the contact's springs.
  class DynamicDeformation : public Deformation
  {
  public:
    /// @param beta Newmark's, at least 1/4 [1]
    /// @param time_step of account() and advance() [s]
    DynamicDeformation(std::unique_ptr<FE::ElasticBody> body,
                       const dealii::Tensor<1, 2>      &initial_velocity,
                       double                           beta,
                       double                           time_step,
                       MPI_Comm                         communicator);

    void
    add_to(Contact::Surface &surface) const override;

    dealii::Tensor<1, 2>
    account(const Contact::Surface &surface, const DriveKick &drive) override;

    void
    change_time_step(double time_step) override;

    void
    advance(double time_step) override;

    double
    strain_energy() const override;

    /// v N v/2 - dt^2 a N a/8 with N = M + beta dt^2 K and the velocity of the
    /// whole step: together with the strain energy what the scheme keeps.
    double
    kinetic_energy() const override;

    dealii::Tensor<1, 2>
    momentum() const override;

    /// sqrt(m v M v), by Schwarz's inequality.
    double
    masses_times_speeds() const override;

    Eigen::VectorXd
    displacement() const override
    {
      return w;
    }

    void
    exchange_state(StateArchive &state) override;

  private:
    /// Over the square of the frequency of what is solved with [s^2].
    double
    scale() const
    {
      return beta * dt * dt;
    }

    /// Of the strained body at its dofs [N/m], K w.
    Eigen::VectorXd
    inner_force() const;

    const MPI_Comm   communicator;
    const bool       first_rank;
    const double     beta;
    double           dt;
    FE::Multifrontal factors; ///< of K + M/(beta dt^2)

    /// Mass and stiffness times a uniform displacement of all dofs or of
    /// the held ones, by component.
    std::array<Eigen::VectorXd, 2> ones, held_ones, mass_of_ones, mass_of_held,
        stiffness_of_held;

    Eigen::VectorXd w, half_velocity, acceleration;
    Eigen::VectorXd outer_loads; ///< of contact and of the drive's motion [N]
    /// Velocity at the whole step, as it was known when the step began [m/s].
    Eigen::VectorXd surface_velocity;
    DriveKick       last_drive{0., {}, {}};
    double          lag = 0.; ///< from the half step to the whole one [s]
  };


  /// Largest square of a frequency [1/s^2] of the mass of a body on contact
  /// springs all along its surface.
  /// @param foundation stiffness per length of surface [N/m^2]
  /// @param tributary length of surface that belongs to each node [m]
  /// @param stiffness_share with M + stiffness_share K in place of M [s^2]
  double
  contact_frequency(const FE::ElasticBody     &body,
                    double                     foundation,
                    const std::vector<double> &tributary,
                    double                     stiffness_share = 0.);
} // namespace Morsel::Jaw

#endif
