#ifndef morsel_sph_static_solid_h
#define morsel_sph_static_solid_h

#include <morsel/fracture/elastic_plane.h>
#include <morsel/sph/discrete_gradient.h>
#include <morsel/sph/stiffness_elements.h>

#include <deal.II/lac/vector.h>

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace Morsel::SPH
{
  /// What a static solution cost and how good it is.
  struct StaticReport
  {
    unsigned int n_dofs             = 0;
    unsigned int n_iterations       = 0;  ///< of conjugate gradients, in all
    unsigned int n_multiplier_steps = 0;  ///< of the supports
    double       condition_number   = 0.; ///< of the preconditioned operator
    double       residual    = 0.; ///< |inner + outer forces|/|outer ones| [1]
    double       support_gap = 0.; ///< largest mean displacement of a held
                                   ///< facet over the largest displacement [1]
    double setup_time = 0., solution_time = 0.; ///< [s]
  };


  /// The small-strain total Lagrangian equations of a particle body in
  /// equilibrium: sum_i V_i sigma(H_i) G_ij plus the residual control balance
  /// the tractions. Tractions and supports act through the trace of the
  /// displacement on the true boundary, facet by facet, although no particle
  /// lies there: a traction's forces have the right moment, and what is held
  /// is the mean displacement of each facet, exactly, by Lagrange
  /// multipliers.
  ///
  /// All forces, energies and works are per metre of depth.
  class StaticSolid
  {
  public:
    /// All arguments but the material are kept by reference.
    /// @param youngs_modulus scales the supports' penalty [Pa]
    StaticSolid(const ShapeFunctions             &shape,
                const DiscreteGradient           &gradient,
                const ResidualControl            &control,
                const std::vector<BoundaryFacet> &boundary,
                const Fracture::ElasticPlane     &material,
                const double                      youngs_modulus);

    /// Uniform traction [Pa] on a side.
    void
    apply_traction(const unsigned int          side,
                   const dealii::Tensor<1, 2> &traction);

    /// A force at a place [N/m].
    void
    apply_force(const ShapeValues &place, const dealii::Tensor<1, 2> &force);

    /// A force on a particle [N/m].
    void
    apply_force(const unsigned int i, const dealii::Tensor<1, 2> &force);

    /// Prescribes the displacement of one component on a side [m].
    void
    hold(const unsigned int side,
         const unsigned int component,
         const double       displacement = 0.);

    /// Prescribes one component of the mean displacement of a facet [m].
    void
    hold(const BoundaryFacet &facet,
         const unsigned int   component,
         const double         displacement = 0.);

    /// No mean displacement of a facet across it.
    void
    hold_across(const BoundaryFacet &facet);

    /// Prescribes one component of the displacement at a place [m].
    void
    pin(const ShapeValues &place,
        const unsigned int component,
        const double       displacement = 0.);

    /// Pins particles against those rigid motions that no support takes. They
    /// carry nothing, since the loads must be in balance along them.
    /// @return number of such motions
    /// @throws InputError, one clause, if the loads are not in balance
    unsigned int
    pin_free_motions();

    /// @throws NumericalError if the body is not held
    VectorField
    solve();

    /// Stress at the particles [Pa] and their displacement gradient [1].
    dealii::SymmetricTensor<2, 2>
    stress(const unsigned int i, const VectorField &u) const;

    /// Strain energy at the particles [J/m].
    double
    strain_energy(const VectorField &u) const;

    /// Work of loads and prescribed displacements that grow in proportion.
    double
    external_work(const VectorField &u) const;

    /// Supports so far: each call that makes some adds to them.
    unsigned int
    n_supports() const
    {
      return constraints.size();
    }

    /// Force of the supports [begin, end) on the body, once it is solved.
    dealii::Tensor<1, 2>
    reaction(const unsigned int begin, const unsigned int end) const;

    const StaticReport &
    get_report() const
    {
      return report;
    }

  private:
    /// Stiffness of a held facet over that of a layer as thick as the facet
    /// is long; multipliers take away what it yields, the faster the stiffer
    /// it is.
    static constexpr double penalty = 1e3;

    /// A prescribed sum_j weight_j.u_j.
    struct Constraint
    {
      double                    stiffness; ///< penalty per (weight times u)^2
      double                    scale;     ///< sum of the weights
      std::vector<unsigned int> index;
      VectorField               weight;
      double                    target     = 0.;
      double                    multiplier = 0.;
    };

    struct Operator;
    class Factorisation;

    /// Solves operator x = rhs by conjugate gradients, from the present x.
    /// @param tolerance of the residual's norm
    void
    solve_linear(dealii::Vector<double>       &x,
                 const dealii::Vector<double> &rhs,
                 const Factorisation          &factors,
                 const double                  tolerance);

    /// Solves for the present multipliers, from the present x.
    void
    improve(dealii::Vector<double> &x,
            const Factorisation    &factors,
            const double            tolerance);

    /// Finds the multipliers where supports depend on each other nearly, so
    /// that steps of them gain little: conjugate gradients on the
    /// supports' gaps, preconditioned by the penalties.
    /// @param x the solution for the present multipliers
    /// @param tolerance of the gaps over the largest displacement [1]
    void
    improve_multipliers(dealii::Vector<double> &x,
                        const Factorisation    &factors,
                        const double            tolerance);

    /// The stiffness matrix, penalties of the supports included, times x.
    dealii::Vector<double>
    force_balance(const dealii::Vector<double> &x) const;
    std::vector<Eigen::Triplet<double>>
    preconditioner_entries() const;
    /// Those of the particles' elements and of the supports'.
    ElementNodes
    all_elements() const;
    void
    element_matrix(const unsigned int e, std::vector<double> &matrix) const;
    /// Tractions and the reactions of the multipliers [N/m].
    dealii::Vector<double>
    outer_force() const;
    void
    update_multipliers(const VectorField &u);
    /// sum_j weight_j.u_j.
    double
    trace(const Constraint &constraint, const VectorField &u) const;
    VectorField
    inner_force(const VectorField &u) const;
    /// Displacements along x and y and a turn about the middle, of size 1.
    std::array<VectorField, 3>
    rigid_motions() const;

    const ShapeFunctions             &shape;
    const DiscreteGradient           &gradient;
    const ResidualControl            &control;
    const std::vector<BoundaryFacet> &boundary;
    StiffnessElements                 elements;
    Fracture::ElasticPlane            material;
    double                            youngs_modulus;
    VectorField                       load; ///< of the tractions [N/m]
    std::vector<Constraint>           constraints;
    StaticReport                      report;
  };
} // namespace Morsel::SPH

#endif
