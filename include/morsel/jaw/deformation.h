#ifndef morsel_jaw_deformation_h
#define morsel_jaw_deformation_h

#include <morsel/contact/surface.h>
#include <morsel/contact/touches.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/fe/elastic_body.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <vector>

namespace Morsel::Jaw
{
  /// How a plate's drive moves between one step and the next [m/s]: its
  /// mean velocities over the last and the next half or whole step.
  struct DriveKick
  {
    double               kick; ///< from one to the other [s]
    dealii::Tensor<1, 2> velocity_before, velocity_after;
  };


  /// The elastic part of a plate's motion: displacement relative to its held
  /// sides, which follow the drive.
  class Deformation
  {
  public:
    explicit Deformation(std::unique_ptr<FE::ElasticBody> body)
        : body(std::move(body))
    {}

    virtual ~Deformation() = default;

    /// How the body is turned as a whole: what the surface and the drive see
    /// is R times what the body has in its own frame.
    void
    turn(const dealii::Tensor<2, 2> &orientation)
    {
      R = orientation;
    }

    /// Adds the displacement of the nodes and their velocities to a surface
    /// that stands where the drive has put it.
    virtual void
    add_to(Contact::Surface &surface) const = 0;

    /// Whether the forces of contact and the displacement wait for each other
    /// at every step: then settle() is called until it says yes.
    virtual bool
    settles() const
    {
      return false;
    }

    /// Takes the forces on the surface as they are. If the body is not in
    /// equilibrium with them, moves the surface's nodes nearer to it.
    /// @param time_step since the last equilibrium [s]
    /// @throws NumericalError where that does not converge
    virtual bool
    settle(Contact::Surface & /*surface*/,
           const std::vector<const Contact::Touches *> & /*touches*/,
           double /*time_step*/)
    {
      return true;
    }

    /// Takes the forces on the surface as those of this step.
    /// @return what the drive gives the body [N]; on the first rank, others
    ///   give zero if the forces are those of all ranks
    virtual dealii::Tensor<1, 2>
    account(const Contact::Surface &surface, const DriveKick &drive) = 0;

    /// The steps from now on [s]; before account().
    virtual void
    change_time_step(double /*time_step*/)
    {}

    /// Moves on by a time step [s].
    virtual void
    advance(double time_step) = 0;

    /// Energies at the last account() [J].
    virtual double
    strain_energy() const = 0;
    virtual double
    kinetic_energy() const
    {
      return 0.;
    }

    /// Momentum at the last half step [kg m/s].
    virtual dealii::Tensor<1, 2>
    momentum() const
    {
      return {};
    }

    /// At least the sum of masses times speeds at that time [kg m/s].
    virtual double
    masses_times_speeds() const
    {
      return 0.;
    }

    /// Of contact on the body so far, where it settles.
    virtual unsigned long long
    n_evaluations() const
    {
      return 0;
    }

    /// By dof, relative to the drive [m].
    virtual Eigen::VectorXd
    displacement() const = 0;

    virtual void
    exchange_state(StateArchive &state) = 0;

    const FE::ElasticBody &
    get_body() const
    {
      return *body;
    }

  protected:
    std::unique_ptr<FE::ElasticBody> body;
    dealii::Tensor<2, 2>             R = dealii::unit_symmetric_tensor<2>();
  };


  /// Forces on a surface's nodes, in the frame of a body turned by R, in the
  /// rows of FE::ElasticBody::trace(): those of all ranks together. Collective.
  Eigen::VectorXd
  nodal_forces(
      const Contact::Surface     &surface,
      const dealii::Tensor<2, 2> &R = dealii::unit_symmetric_tensor<2>(),
      MPI_Comm                    communicator = MPI_COMM_SELF);

  /// A node's entries of such a vector, turned by R.
  inline dealii::Tensor<1, 2>
  turned(const dealii::Tensor<2, 2> &R,
         const Eigen::VectorXd      &v,
         const unsigned int          node)
  {
    return R * dealii::Tensor<1, 2>({v[2 * node], v[2 * node + 1]});
  }
} // namespace Morsel::Jaw

#endif
