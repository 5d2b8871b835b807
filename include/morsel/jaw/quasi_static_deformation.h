#ifndef morsel_jaw_quasi_static_deformation_h
#define morsel_jaw_quasi_static_deformation_h

#include <morsel/jaw/deformation.h>

#include <array>

namespace Morsel::Jaw
{
  /// An elastic body without inertia: at every step in equilibrium with the
  /// contact forces, which depend on its displacement in turn. The body is
  /// condensed to its surface: the compliance of the nodes that food has
  /// touched so far, one solution each. Newton's method finds the
  /// equilibrium, so that contact may be any number of times stiffer than the
  /// body; its matrix is kept as long as it converges fast.
  class QuasiStaticDeformation : public Deformation
  {
  public:
    /// @param communicator of the ranks that share the food; each has the
    ///   whole body. Collective, as is settle().
    /// @pre held
    QuasiStaticDeformation(std::unique_ptr<FE::ElasticBody> body,
                           MPI_Comm                         communicator);

    void
    add_to(Contact::Surface &surface) const override;

    bool
    settles() const override
    {
      return true;
    }

    bool
    settle(Contact::Surface                            &surface,
           const std::vector<const Contact::Touches *> &touches,
           double                                       time_step) override;

    /// A body without mass passes on what it gets.
    dealii::Tensor<1, 2>
    account(const Contact::Surface &surface, const DriveKick &drive) override;

    void
    advance(double time_step) override;

    /// On the first rank, zero on others.
    double
    strain_energy() const override;

    Eigen::VectorXd
    displacement() const override;

    unsigned long long
    n_evaluations() const override
    {
      return evaluations;
    }

    void
    exchange_state(StateArchive &state) override;

  private:
    using TouchLists = std::vector<const Contact::Touches *>;

    Contact::Touches
    touches_of_all_ranks(const TouchLists &touches) const;

    void
    make_columns(unsigned int node);

    Eigen::VectorXd
    deflection(const Eigen::VectorXd &f) const;

    /// Whether the matrix at hand covers all nodes that are touched.
    bool
    covers(const Contact::Touches &touches) const;

    void
    make_matrix(const Contact::Touches &touches);

    /// That of the nodes touched, from their contact stiffness.
    void
    factorise_matrix();

    const MPI_Comm   communicator;
    FE::Multifrontal factors;
    /// By node, component: the displacement of all nodes under a unit force
    /// [m/N]; empty for those never touched.
    std::vector<std::array<Eigen::VectorXd, 2>> compliance;

    Eigen::VectorXd w, force;     ///< of the surface's nodes [m], [N]
    Eigen::VectorXd settled_last; ///< w a step ago
    Eigen::VectorXd rate;         ///< over the last step [m/s]

    std::vector<unsigned int>            touched; ///< nodes of the matrix
    std::vector<int>                     place;   ///< in touched, or -1
    Eigen::MatrixXd                      contact_stiffness;
    Eigen::PartialPivLU<Eigen::MatrixXd> matrix; ///< I + C K_contact
    double                               least_difference = 0.; ///< [m]
    double             amplification = 0.; ///< largest row sum of C K_contact
    unsigned int       attempt       = 0;
    double             last_residual = 0.;
    unsigned long long evaluations   = 0;
  };
} // namespace Morsel::Jaw

#endif
