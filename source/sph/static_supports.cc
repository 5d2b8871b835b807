#include <morsel/core/errors.h>
#include <morsel/sph/field_vectors.h>
#include <morsel/sph/static_solid.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    using Modes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

    /// Loads may be so far out of balance along a motion that nothing holds,
    /// in units of their sum.
    constexpr double balance_tolerance = 1e-8;

    constexpr unsigned int largest_step_count = 60;
    constexpr double       dual_tolerance     = 1e-11;


    /// How much of the first @p n modes a displacement of one component of a
    /// particle is.
    double
    share(const Modes                      &modes,
          const unsigned int                n,
          const std::array<VectorField, 3> &motions,
          const unsigned int                i,
          const unsigned int                d)
    {
      double sum = 0.;
      for (unsigned int m = 0; m < n; ++m)
        {
          double moved = 0.;
          for (unsigned int k = 0; k < 3; ++k)
            moved += modes.eigenvectors()(k, m) * motions[k][i][d];
          sum += moved * moved;
        }
      return sum;
    }
  } // namespace


  std::array<VectorField, 3>
  StaticSolid::rigid_motions() const
  {
    const auto  &points = shape.get_cloud().points;
    Tensor<1, 2> middle;
    for (const Point<2> &x : points)
      middle += Tensor<1, 2>(x) / static_cast<double>(points.size());
    double size = 0.;
    for (const Point<2> &x : points)
      size = std::max(size, (Tensor<1, 2>(x) - middle).norm());
    std::array<VectorField, 3> motions;
    for (const Point<2> &x : points)
      {
        const Tensor<1, 2> r = (Tensor<1, 2>(x) - middle) / size;
        motions[0].push_back(Tensor<1, 2>({1., 0.}));
        motions[1].push_back(Tensor<1, 2>({0., 1.}));
        motions[2].push_back(Tensor<1, 2>({-r[1], r[0]}));
      }
    return motions;
  }


  unsigned int
  StaticSolid::pin_free_motions()
  {
    const auto      motions = rigid_motions();
    Eigen::Matrix3d held    = Eigen::Matrix3d::Zero();
    for (const Constraint &c : constraints)
      {
        // What the support sees of each motion.
        Eigen::Vector3d seen;
        for (unsigned int k = 0; k < 3; ++k)
          seen(k) = trace(c, motions[k]) / c.scale;
        held += seen * seen.transpose();
      }
    Modes        modes(held);
    unsigned int n_free = 0;
    while (n_free < 3 && modes.eigenvalues()(n_free) <
                             1e-10 * std::max(1., modes.eigenvalues()(2)))
      ++n_free;

    double          sum          = 0.;
    Eigen::Vector3d along_motion = Eigen::Vector3d::Zero();
    for (unsigned int i = 0; i < load.size(); ++i)
      {
        sum += load[i].norm();
        for (unsigned int k = 0; k < 3; ++k)
          along_motion(k) += load[i] * motions[k][i];
      }
    for (unsigned int m = 0; m < n_free; ++m)
      if (std::abs(modes.eigenvectors().col(m).dot(along_motion)) >
          balance_tolerance * sum)
        throw InputError("its supports leave it free to move or turn, and its "
                         "loads are not in balance: clamp it, or give it "
                         "rollers");

    // A particle in the middle and the one farthest from it.
    unsigned int near = 0, far = 0;
    for (unsigned int i = 0; i < load.size(); ++i)
      {
        const double turn = motions[2][i].norm_square();
        near              = turn < motions[2][near].norm_square() ? i : near;
        far               = turn > motions[2][far].norm_square() ? i : far;
      }
    for (unsigned int n = n_free; n > 0; --n)
      {
        std::pair<unsigned int, unsigned int> best{near, 0};
        for (const unsigned int i : {near, far})
          for (unsigned int d = 0; d < 2; ++d)
            if (share(modes, n, motions, i, d) >
                1.01 * share(modes, n, motions, best.first, best.second))
              best = {i, d};
        pin({{best.first}, {1.}}, best.second);
        const Eigen::Vector3d seen(motions[0][best.first][best.second],
                                   motions[1][best.first][best.second],
                                   motions[2][best.first][best.second]);
        held += seen * seen.transpose();
        modes.compute(held);
      }
    return n_free;
  }


  void
  StaticSolid::improve_multipliers(Vector<double>      &x,
                                   const Factorisation &factors,
                                   const double         tolerance)
  {
    const unsigned int  n = constraints.size();
    std::vector<double> gap(n), direction(n, 0.), change(n);
    const VectorField   u = to_field(x);
    for (unsigned int c = 0; c < n; ++c)
      gap[c] = trace(constraints[c], u) - constraints[c].target;
    double old_product = 0.;
    for (unsigned int step = 0; step < largest_step_count; ++step)
      {
        double product = 0., largest_gap = 0.;
        for (unsigned int c = 0; c < n; ++c)
          {
            product += constraints[c].stiffness * gap[c] * gap[c];
            largest_gap =
                std::max(largest_gap, std::abs(gap[c]) / constraints[c].scale);
          }
        if (largest_gap <= tolerance * largest(to_field(x)))
          break;
        const double beta = step == 0 ? 0. : product / old_product;
        old_product       = product;
        VectorField force(load.size());
        for (unsigned int c = 0; c < n; ++c)
          {
            direction[c] =
                constraints[c].stiffness * gap[c] + beta * direction[c];
            for (unsigned int k = 0; k < constraints[c].index.size(); ++k)
              force[constraints[c].index[k]] +=
                  direction[c] * constraints[c].weight[k];
          }
        Vector<double>       response(x.size());
        const Vector<double> rhs = to_vector(force);
        solve_linear(response, rhs, factors, dual_tolerance * rhs.l2_norm());
        const VectorField moved     = to_field(response);
        double            curvature = 0.;
        for (unsigned int c = 0; c < n; ++c)
          {
            change[c] = trace(constraints[c], moved);
            curvature += direction[c] * change[c];
          }
        const double alpha = product / curvature;
        for (unsigned int c = 0; c < n; ++c)
          {
            constraints[c].multiplier += alpha * direction[c];
            gap[c] -= alpha * change[c];
          }
        x.add(-alpha, response);
        ++report.n_multiplier_steps;
      }
  }
} // namespace Morsel::SPH
