#ifndef morsel_fe_elastic_problem_h
#define morsel_fe_elastic_problem_h

#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/element_system.h>
#include <morsel/fe/xfem_space.h>
#include <morsel/fracture/elastic_plane.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Morsel::FE
{
  /// What a solve cost and how hard it was.
  struct SolveReport
  {
    std::string  solver;
    unsigned int n_dofs           = 0;  ///< free ones
    unsigned int n_iterations     = 0;  ///< 0: direct
    double       condition_number = 0.; ///< of the preconditioned matrix, by
                                        ///< Lanczos; 0: not known
    unsigned int n_patch_dofs     = 0;  ///< solved directly in each iteration
    unsigned int n_dropped_pivots = 0;
    double       smallest_pivot   = 0.; ///< relative to the diagonal
    double       assembly_time    = 0.; ///< [s]
    double       solve_time       = 0.; ///< [s]
  };


  enum class SolverKind
  {
    multifrontal, ///< Cholesky by elements, factorised on the first rank
    iterative,    ///< conjugate gradients with CrackPreconditioner
    umfpack       ///< LU of the assembled matrix, one rank
  };


  /// Static linear elasticity on an XFEM space: boundary conditions,
  /// assembly, solution.
  class ElasticProblem
  {
  public:
    using Field =
        std::function<dealii::Tensor<1, 2>(const dealii::Point<2>     &p,
                                           const dealii::Tensor<1, 2> &normal)>;
    using Solution = dealii::LinearAlgebra::distributed::Vector<double>;

    ElasticProblem(const XFEMSpace              &space,
                   const Fracture::ElasticPlane &material);

    /// Traction [Pa] on a part of the boundary.
    void
    apply_traction(const dealii::types::boundary_id id, const Field &traction);

    /// Zero displacement of one component on a part of the boundary: a clamp
    /// is both components, a roller one.
    void
    hold(const dealii::types::boundary_id id, const unsigned int component);

    /// Zero displacement of one component at the vertex nearest to a point.
    void
    pin(const dealii::Point<2> &point, const unsigned int component);

    /// Prescribed displacement [m] on the given parts of the boundary, or
    /// the chosen components of it, imposed as the L2 projection on the trace
    /// of the enriched space, so that it may jump where a crack meets the
    /// boundary. Collective.
    void
    prescribe(const std::set<dealii::types::boundary_id> &ids,
              const Field                                &displacement,
              const std::array<bool, 2> &components = {{true, true}});

    /// Solves and returns the displacement in the space's dofs, with ghost
    /// values.
    /// @throws NumericalError if the body is not held, or if the iteration does
    ///   not converge
    Solution
    solve(const SolverKind kind);

    const SolveReport &
    get_report() const
    {
      return report;
    }

    /// Strain energy [J/m]: half the integral of stress times strain.
    double
    strain_energy(const Solution &solution) const;

    /// Work of the applied tractions [J/m], the integral of traction times
    /// displacement.
    double
    traction_work(const Solution &solution) const;

    /// The traction that a stress on the boundary fails to balance [Pa]:
    /// sigma n minus what is applied there, in the directions not held.
    dealii::Tensor<1, 2>
    missed_traction(const dealii::types::boundary_id     id,
                    const dealii::Point<2>              &p,
                    const dealii::Tensor<1, 2>          &normal,
                    const dealii::SymmetricTensor<2, 2> &stress) const;

    const XFEMSpace &
    get_space() const
    {
      return space;
    }

    const Fracture::ElasticPlane &
    get_material() const
    {
      return material;
    }

  private:
    using Cell = dealii::DoFHandler<2>::active_cell_iterator;

    dealii::AffineConstraints<double>
    make_constraints() const;
    void
    add_traction(const Cell      &cell,
                 const QuadMap   &map,
                 Eigen::VectorXd &rhs) const;
    void
    for_each_element(
        const std::function<void(const Cell &,
                                 const Eigen::MatrixXd &,
                                 const Eigen::VectorXd &)> &sink) const;
    std::vector<ElementSystem>
    collect_elements(
        const dealii::AffineConstraints<double> &constraints) const;
    Solution
    solve_multifrontal(const dealii::AffineConstraints<double> &constraints);
    Solution
    solve_iterative(const dealii::AffineConstraints<double> &constraints);
    Solution
    solve_umfpack(const dealii::AffineConstraints<double> &constraints);
    Solution
    make_solution() const;
    unsigned int
    n_free_dofs(const dealii::AffineConstraints<double> &constraints) const;

    const XFEMSpace                                                 &space;
    Fracture::ElasticPlane                                           material;
    std::vector<std::pair<dealii::types::boundary_id, Field>>        tractions;
    std::vector<std::pair<dealii::types::boundary_id, unsigned int>> holds;
    std::vector<std::pair<dealii::Point<2>, unsigned int>>           pins;
    std::map<dealii::types::global_dof_index, double>                prescribed;
    SolveReport                                                      report;
  };


  /// Points on one face of a cell, split where a crack crosses it: along the
  /// face [m], with weights [m].
  CellQuadrature
  face_quadrature(const QuadMap                      &map,
                  const unsigned int                  face,
                  const std::vector<Fracture::Crack> &cracks,
                  const unsigned int                  n);
} // namespace Morsel::FE

#endif
