#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/sph/field_vectors.h>
#include <morsel/sph/neighbour_stiffness.h>
#include <morsel/sph/static_solid.h>

#include <deal.II/base/timer.h>

#include <deal.II/lac/solver_cg.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int simple_multiplier_step_count = 8;
    constexpr double       final_tolerance              = 1e-13;
    constexpr double       gap_tolerance                = 1e-12;
    constexpr double       largest_gap                  = 1e-6;
    constexpr unsigned int largest_iteration_count      = 2000;
    /// Of exact factors: 1 GB.
    constexpr double largest_entry_count = 1.25e8;
  } // namespace


  /// A preconditioner: the stiffness matrix's own factors if they fit into
  /// memory and exist, else those of one that couples neighbours only.
  class StaticSolid::Factorisation
  {
  public:
    Factorisation(const StaticSolid &solid)
        : nodes(solid.all_elements())
        , order(solid.shape.get_cloud().points, nodes)
    {
      if (order.n_entries() <= largest_entry_count)
        exact = std::make_unique<MultifrontalCholesky>(
            order,
            nodes,
            [&](const unsigned int e, std::vector<double> &matrix) {
              solid.element_matrix(e, matrix);
            });
      if (exact && exact->succeeded())
        return;
      exact.reset();
      const auto                  entries = solid.preconditioner_entries();
      Eigen::SparseMatrix<double> lower(2 * solid.load.size(),
                                        2 * solid.load.size());
      lower.setFromTriplets(entries.begin(), entries.end());
      factors.compute(lower);
      if (factors.info() != Eigen::Success)
        throw NumericalError("The particle body is not held: support it, or "
                             "keep cracks from cutting parts off.");
    }

    void
    vmult(Vector<double> &y, const Vector<double> &x) const
    {
      if (exact)
        exact->solve(y.begin(), x.begin());
      else
        Eigen::Map<Eigen::VectorXd>(y.begin(), y.size()) = factors.solve(
            Eigen::Map<const Eigen::VectorXd>(x.begin(), x.size()));
    }

  private:
    const ElementNodes                                              nodes;
    const Dissection                                                order;
    std::unique_ptr<MultifrontalCholesky>                           exact;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors;
  };


  /// The stiffness matrix with the supports' penalties.
  struct StaticSolid::Operator
  {
    void
    vmult(Vector<double> &y, const Vector<double> &x) const
    {
      y = solid.force_balance(x);
    }

    const StaticSolid &solid;
  };


  StaticSolid::StaticSolid(const ShapeFunctions             &shape,
                           const DiscreteGradient           &gradient,
                           const ResidualControl            &control,
                           const std::vector<BoundaryFacet> &boundary,
                           const Fracture::ElasticPlane     &material,
                           const double                      youngs_modulus)
      : shape(shape)
      , gradient(gradient)
      , control(control)
      , boundary(boundary)
      , elements(gradient, control, material)
      , material(material)
      , youngs_modulus(youngs_modulus)
      , load(gradient.volume.size())
  {}


  double
  StaticSolid::trace(const Constraint &constraint, const VectorField &u) const
  {
    double sum = 0.;
    for (unsigned int k = 0; k < constraint.index.size(); ++k)
      sum += constraint.weight[k] * u[constraint.index[k]];
    return sum;
  }


  VectorField
  StaticSolid::inner_force(const VectorField &u) const
  {
    TensorField sigma(u.size());
    for (unsigned int i = 0; i < u.size(); ++i)
      sigma[i] = stress(i, u);
    VectorField force(u.size());
    gradient.add_force(sigma, force);
    control.add_force(u, force);
    return force;
  }


  Vector<double>
  StaticSolid::force_balance(const Vector<double> &x) const
  {
    Vector<double> force(x.size());
    elements.vmult(force, x);
    for (const Constraint &c : constraints)
      {
        double sum = 0.;
        for (unsigned int k = 0; k < c.index.size(); ++k)
          for (unsigned int d = 0; d < 2; ++d)
            sum += c.weight[k][d] * x(2 * c.index[k] + d);
        for (unsigned int k = 0; k < c.index.size(); ++k)
          for (unsigned int d = 0; d < 2; ++d)
            force(2 * c.index[k] + d) += c.stiffness * sum * c.weight[k][d];
      }
    return force;
  }


  ElementNodes
  StaticSolid::all_elements() const
  {
    ElementNodes result = elements.get_nodes();
    for (const Constraint &c : constraints)
      {
        result.index.insert(result.index.end(), c.index.begin(), c.index.end());
        result.start.push_back(result.index.size());
      }
    return result;
  }


  void
  StaticSolid::element_matrix(const unsigned int   e,
                              std::vector<double> &matrix) const
  {
    if (e < load.size())
      return elements.matrix(e, matrix);
    const Constraint  &c = constraints[e - load.size()];
    const unsigned int n = 2 * c.index.size();
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int a = b; a < n; ++a)
        matrix[b * n + a] =
            c.stiffness * c.weight[a / 2][a % 2] * c.weight[b / 2][b % 2];
  }


  std::vector<Eigen::Triplet<double>>
  StaticSolid::preconditioner_entries() const
  {
    std::vector<Eigen::Triplet<double>> entries =
        neighbour_stiffness(shape, material);
    const auto add = [&](const unsigned int row,
                         const unsigned int column,
                         const double       value) {
      if (row >= column && value != 0.)
        entries.emplace_back(row, column, value);
    };
    for (const Constraint &c : constraints)
      for (unsigned int k = 0; k < c.index.size(); ++k)
        for (unsigned int l = 0; l < c.index.size(); ++l)
          for (unsigned int d = 0; d < 2; ++d)
            for (unsigned int e = 0; e < 2; ++e)
              add(2 * c.index[k] + d,
                  2 * c.index[l] + e,
                  c.stiffness * c.weight[k][d] * c.weight[l][e]);
    return entries;
  }


  Vector<double>
  StaticSolid::outer_force() const
  {
    VectorField outer = load;
    for (const Constraint &c : constraints)
      for (unsigned int k = 0; k < c.index.size(); ++k)
        outer[c.index[k]] -= c.multiplier * c.weight[k];
    return to_vector(outer);
  }


  void
  StaticSolid::update_multipliers(const VectorField &u)
  {
    report.support_gap = 0.;
    for (Constraint &c : constraints)
      {
        const double g = trace(c, u) - c.target;
        c.multiplier += c.stiffness * g;
        report.support_gap =
            std::max(report.support_gap, std::abs(g) / c.scale);
      }
    if (report.support_gap > 0.)
      report.support_gap /= largest(u);
  }


  void
  StaticSolid::solve_linear(Vector<double>       &x,
                            const Vector<double> &rhs,
                            const Factorisation  &factors,
                            const double          tolerance)
  {
    SolverControl            control(largest_iteration_count, tolerance);
    SolverCG<Vector<double>> solver(control);
    solver.connect_condition_number_slot([&](const double condition) {
      report.condition_number = std::max(report.condition_number, condition);
    });
    try
      {
        solver.solve(Operator{*this}, x, rhs, factors);
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw NumericalError(
            "The particles' equilibrium was not found within " +
            std::to_string(largest_iteration_count) +
            " iterations: the body is hardly held, or zero-energy modes are "
            "free; raise 'SPH/Hourglass coefficient' or support the body.");
      }
    report.n_iterations += control.last_step();
  }


  void
  StaticSolid::improve(Vector<double>      &x,
                       const Factorisation &factors,
                       const double         tolerance)
  {
    Vector<double> rhs   = outer_force();
    const double   force = rhs.l2_norm();
    for (const Constraint &c : constraints)
      for (unsigned int k = 0; k < c.index.size(); ++k)
        for (unsigned int d = 0; d < 2; ++d)
          rhs(2 * c.index[k] + d) += c.stiffness * c.target * c.weight[k][d];
    // The penalty times a prescribed displacement exceeds the reactions by far;
    // before the first step of the multipliers it is all there is.
    solve_linear(x,
                 rhs,
                 factors,
                 force > 0. ? tolerance * force + 1e-15 * rhs.l2_norm()
                            : tolerance * rhs.l2_norm());
  }


  VectorField
  StaticSolid::solve()
  {
    Timer               timer;
    const unsigned int  n_dofs = 2 * load.size();
    const Factorisation factors(*this);
    report.n_dofs     = n_dofs;
    report.setup_time = timer.wall_time();
    timer.restart();

    Vector<double> x(n_dofs);
    const auto     step = [&](const double tolerance) {
      improve(x, factors, tolerance);
      update_multipliers(to_field(x));
      ++report.n_multiplier_steps;
      return tolerance <= final_tolerance && report.support_gap < gap_tolerance;
    };
    bool found = false;
    for (double tolerance = 1e-4;
         !found && report.n_multiplier_steps < simple_multiplier_step_count;
         // Every step of the multipliers gains as many digits.
         tolerance = std::max(final_tolerance, tolerance / penalty))
      found = step(tolerance);
    if (!found)
      {
        improve(x, factors, final_tolerance);
        improve_multipliers(x, factors, 0.1 * gap_tolerance);
        step(final_tolerance);
        if (!(report.support_gap < largest_gap))
          throw NumericalError(
              "The particles' supports were not met after " +
              std::to_string(report.n_multiplier_steps) +
              " steps of their multipliers (gap " +
              number_text(report.support_gap) +
              " of the largest displacement): supports that contradict each "
              "other where they meet; let each side be held by one condition.");
      }
    const VectorField    u       = to_field(x);
    Vector<double>       balance = to_vector(inner_force(u));
    const Vector<double> outer   = outer_force();
    balance += outer;
    if (balance.l2_norm() > 0.)
      report.residual = balance.l2_norm() / outer.l2_norm();
    report.solution_time = timer.wall_time();
    return u;
  }


  double
  StaticSolid::external_work(const VectorField &u) const
  {
    double work = 0.;
    for (unsigned int i = 0; i < u.size(); ++i)
      work += 0.5 * load[i] * u[i];
    for (const Constraint &c : constraints)
      work -= 0.5 * c.multiplier * c.target;
    return work;
  }


  Tensor<1, 2>
  StaticSolid::reaction(const unsigned int begin, const unsigned int end) const
  {
    Tensor<1, 2> sum;
    for (unsigned int c = begin; c < end; ++c)
      for (const Tensor<1, 2> &weight : constraints[c].weight)
        sum -= constraints[c].multiplier * weight;
    return sum;
  }


  SymmetricTensor<2, 2>
  StaticSolid::stress(const unsigned int i, const VectorField &u) const
  {
    return material.stress(gradient.gradient(i, u));
  }


  double
  StaticSolid::strain_energy(const VectorField &u) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < u.size(); ++i)
      {
        const Tensor<2, 2> H = gradient.gradient(i, u);
        sum += 0.5 * gradient.volume[i] *
               scalar_product(Tensor<2, 2>(material.stress(H)), H);
      }
    return sum + control.energy(u);
  }
} // namespace Morsel::SPH
