#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/sph/host.h>
#include <morsel/sph/velocity_constraints.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace Morsel::SPH
{
  namespace
  {
    /// By which targets of traces that depend on each other may differ, over
    /// the largest of them.
    constexpr double largest_difference = 1e-6;

    /// What a motion may be faster inside than the targets at the edge.
    constexpr double faster_inside = 2.;

    /// Eigenvalues below this share of the largest are zero.
    constexpr double zero_eigenvalue = 1e-10;

    /// Below this traces nearly depend on each other; others are at 0.7.
    constexpr double small_eigenvalue = 0.1;

    /// The first meets the targets, the others take round-off away.
    constexpr unsigned int most_corrections = 4;

    using Matrix = Eigen::MatrixXd;
    using Column = Eigen::VectorXd;


    /// W of some traces: a row for each, a column for each of their particles.
    struct Weights
    {
      Matrix                    weight;
      std::vector<unsigned int> particle; ///< of the columns

      explicit Weights(const std::vector<Prescribed *> &constraints)
      {
        std::map<unsigned int, unsigned int> column;
        for (const Prescribed *q : constraints)
          for (const unsigned int i : q->trace.particle)
            if (column.emplace(i, particle.size()).second)
              particle.push_back(i);
        weight = Matrix::Zero(constraints.size(), particle.size());
        for (unsigned int k = 0; k < constraints.size(); ++k)
          {
            const Trace &trace = constraints[k]->trace;
            for (unsigned int m = 0; m < trace.particle.size(); ++m)
              weight(k, column[trace.particle[m]]) += trace.weight[m];
          }
      }
    };


    /// By how much each trace misses its target, velocity less target, and
    /// behind that how fast particles are, no less than the fastest [m/s].
    Column
    find_gaps(const std::vector<Prescribed *> &constraints,
              double Vector2::*const       direction,
              const Particles             &p,
              const double                 kick,
              const ParticleHost<2> *const ranks)
    {
      const unsigned int n = constraints.size();
      Column             gaps(n + 1);
      gaps(n) = 0.;
      for (unsigned int k = 0; k < n; ++k)
        {
          const Prescribed &q = *constraints[k];
          gaps(k)             = q.counts ? -(q.target.*direction) : 0.;
          for (unsigned int m = 0; m < q.trace.particle.size(); ++m)
            {
              const unsigned int i    = q.trace.particle[m];
              const double       next = p.half_velocity[i].*direction +
                                  kick * p.acceleration[i].*direction;
              gaps(k) += q.trace.weight[m] * next;
              gaps(n) = std::max(gaps(n), std::abs(next));
            }
        }
      if (ranks)
        ranks->sum(dealii::ArrayView<double>(gaps.data(), gaps.size()));
      return gaps;
    }
  } // namespace


  std::vector<std::vector<unsigned int>>
  coupled_groups(const std::vector<Prescribed *> &constraints)
  {
    std::vector<unsigned int> parent(constraints.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&parent](unsigned int k) {
      while (parent[k] != k)
        k = parent[k] = parent[parent[k]];
      return k;
    };
    std::map<unsigned int, unsigned int> first_of_particle;
    for (unsigned int k = 0; k < constraints.size(); ++k)
      for (const unsigned int i : constraints[k]->trace.particle)
        parent[root(k)] = root(first_of_particle.emplace(i, k).first->second);
    std::map<unsigned int, std::vector<unsigned int>> groups;
    for (unsigned int k = 0; k < constraints.size(); ++k)
      groups[root(k)].push_back(k);
    std::vector<std::vector<unsigned int>> result;
    for (auto &group : groups)
      result.push_back(std::move(group.second));
    return result;
  }


  VelocityConstraints::VelocityConstraints(std::vector<Prescribed *>  in_x,
                                           std::vector<Prescribed *>  in_y,
                                           const std::vector<double> &mass)
  {
    components.push_back(make_component(&Vector2::x, std::move(in_x), mass));
    components.push_back(make_component(&Vector2::y, std::move(in_y), mass));
  }


  VelocityConstraints::Component
  VelocityConstraints::make_component(double Vector2::*const     direction,
                                      std::vector<Prescribed *>  constraints,
                                      const std::vector<double> &mass)
  {
    Component                           result;
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto &group : coupled_groups(constraints))
      {
        std::vector<Prescribed *> coupled;
        for (const unsigned int k : group)
          coupled.push_back(constraints[k]);
        const Weights W(coupled);
        Column        mobility(W.particle.size());
        for (unsigned int i = 0; i < W.particle.size(); ++i)
          mobility(i) = 1. / mass[W.particle[i]];
        const Matrix A =
            W.weight * mobility.asDiagonal() * W.weight.transpose();
        const Column scale = A.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::SelfAdjointEigenSolver<Matrix> eigen(
            scale.asDiagonal() * A * scale.asDiagonal());
        const double largest = eigen.eigenvalues().maxCoeff();
        Matrix       inverse = Matrix::Zero(coupled.size(), coupled.size());
        for (unsigned int k = 0; k < coupled.size(); ++k)
          {
            const double value = eigen.eigenvalues()(k);
            Column share = scale.cwiseProduct(eigen.eigenvectors().col(k));
            if (value > zero_eigenvalue * largest)
              inverse += share * share.transpose() / value;
            if (value >= small_eigenvalue * largest)
              continue;
            share *= 2. / share.lpNorm<1>();
            const double motion = (W.weight.transpose() * share).lpNorm<1>();
            result.modes.push_back(
                {coupled, share, faster_inside * motion + largest_difference});
          }
        for (unsigned int k = 0; k < group.size(); ++k)
          for (unsigned int l = 0; l < group.size(); ++l)
            entries.emplace_back(group[k], group[l], inverse(k, l));
      }
    result.inverse.resize(constraints.size(), constraints.size());
    result.inverse.setFromTriplets(entries.begin(), entries.end());
    result.direction   = direction;
    result.constraints = std::move(constraints);
    return result;
  }


  void
  VelocityConstraints::check_targets(const Component   &component,
                                     const std::string &body)
  {
    for (const Mode &mode : component.modes)
      {
        double difference = 0., largest = 0.;
        for (unsigned int k = 0; k < mode.constraints.size(); ++k)
          {
            const double target =
                mode.constraints[k]->target.*component.direction;
            difference += mode.share(k) * target;
            largest = std::max(largest, std::abs(target));
          }
        if (std::abs(difference) > mode.allowance * largest)
          throw NumericalError(
              "The conditions of body '" + body +
              "' prescribe motions that contradict each other (they differ "
              "by " +
              number_text(std::abs(difference)) + " of " +
              number_text(largest) +
              " m/s): let each side be moved or held by one of them, and let "
              "those that meet at a corner agree there.");
      }
  }


  void
  VelocityConstraints::meet_targets(const Component             &component,
                                    Particles                   &p,
                                    const double                 kick,
                                    const ParticleHost<2> *const ranks)
  {
    const unsigned int size  = component.constraints.size();
    double             first = 0.;
    for (unsigned int n = 0; n < most_corrections; ++n)
      {
        const Column found = find_gaps(
            component.constraints, component.direction, p, kick, ranks);
        const auto   gaps    = found.head(size);
        const double speed   = found(size);
        const double largest = gaps.lpNorm<Eigen::Infinity>();
        if (n == 0)
          first = largest;
        if (!(largest > 1e-12 * first + 1e-14 * speed))
          return;
        const Column reactions = component.inverse * gaps / -kick;
        for (unsigned int k = 0; k < size; ++k)
          {
            Prescribed  &q     = *component.constraints[k];
            const Trace &trace = q.trace;
            q.reaction.*component.direction += reactions(k);
            for (unsigned int m = 0; m < trace.particle.size(); ++m)
              {
                const unsigned int i = trace.particle[m];
                p.acceleration[i].*component.direction +=
                    trace.weight[m] * reactions(k) / p.mass[i];
              }
          }
      }
  }


  void
  VelocityConstraints::enforce(Particles                   &particles,
                               const double                 kick,
                               const std::string           &body,
                               const ParticleHost<2> *const ranks) const
  {
    for (const Component &component : components)
      if (!component.constraints.empty())
        {
          check_targets(component, body);
          meet_targets(component, particles, kick, ranks);
        }
  }

} // namespace Morsel::SPH
