#ifndef morsel_sph_discrete_gradient_h
#define morsel_sph_discrete_gradient_h

#include <morsel/core/kernel.h>
#include <morsel/sph/cloud.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/normalisation.h>
#include <morsel/sph/shape_functions.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace Morsel::SPH
{
  using VectorField = std::vector<dealii::Tensor<1, 2>>;
  using TensorField = std::vector<dealii::Tensor<2, 2>>;


  /// The gradient of a displacement at particles, as data: entry k of row i
  /// holds a neighbour j and G_ij, so that
  ///   H_i = sum_j (u_j - u_i) (x) G_ij,  F_i = I + H_i,
  /// and the force of stresses P_i is the exact adjoint of it,
  ///   f_j = -sum_i V_i P_i G_ij  with  G_ii = -sum_j G_ij.
  /// Whatever G is, work and energy agree and momentum is kept; constant
  /// stresses make no force inside of the body if sum_i V_i G_ij is the
  /// surface vector of j.
  struct DiscreteGradient
  {
    NeighbourList       list;   ///< without the particle itself
    VectorField         weight; ///< G_ij [1/m]
    std::vector<double> volume; ///< V_i per metre of depth [m^2]

    /// H_i [1].
    dealii::Tensor<2, 2>
    gradient(const unsigned int i, const VectorField &u) const;

    /// Adds the force of stresses (first Piola-Kirchhoff, or Cauchy at small
    /// strain) [N/m].
    /// @param stress P_i [Pa]
    void
    add_force(const TensorField &stress, VectorField &force) const;
  };


  /// G_ij of the kernel's gradient, normalised: G_ij = V_j |W'|/R B_i X_ij,
  /// with the gradient matrix (Randles and Libersky 1996) exact for linear
  /// fields, B_i = (sum_j V_j |W'|/R X_ij (x) X_ij)^-1. Pairs that do not see
  /// each other are left out.
  DiscreteGradient
  normalised_gradient(const ShapeFunctions &shape,
                      const Normalisation   normalisation);


  /// G_ij of stabilised conforming nodal integration (Chen, Wu, Yoon and You
  /// 2001): 1/V_i times the integral of Phi_j n over the boundary of i's
  /// Voronoi cell, two Gauss points per facet (one breaks the patch test).
  /// The facet between two particles that see each other is seen from the
  /// middle between them by both; a facet on a crack from its owner, and one
  /// between two whose line of sight leaves the body at a notch from its own
  /// middle.
  DiscreteGradient
  conforming_gradient(const ShapeFunctions &shape);


  /// Resistance to what a linear displacement does not explain (zero-energy
  /// modes): E = 1/4 sum_ij k_ij |u_j - u_i - H_i (X_j - X_i)|^2,
  /// H_i the least-squares fit with the weights k_ij (so that the force needs
  /// no further term), k_ij = alpha E V_i V_j W_ij/|X_ij|^2.
  struct ResidualControl
  {
    NeighbourList       list;
    std::vector<double> stiffness; ///< k_ij [Pa]
    VectorField         offset;    ///< X_j - X_i [m]
    /// (sum_j k_ij X_ij (x) X_ij)^-1. Where no line can be fitted it is zero
    /// and so are the row's k_ij.
    TensorField inverse_moment;

    /// u_j - u_i - H_i X_ij for all j of row i [m].
    void
    residual(const unsigned int i,
             const VectorField &u,
             VectorField       &residuals) const;

    /// E [J/m].
    double
    energy(const VectorField &u) const;

    /// Adds -dE/du [N/m].
    void
    add_force(const VectorField &u, VectorField &force) const;
  };

  /// @param modulus alpha times Young's modulus [Pa]
  ResidualControl
  residual_control(const ShapeFunctions &shape, const double modulus);


  /// The trace of a displacement on what a particle's cell has of a side:
  /// integral of u over it = sum_j weight_j u_j [m^2], that of u.n = sum_j
  /// flux_j.u_j [m^2].
  struct BoundaryFacet
  {
    unsigned int side = 0;                   ///< left, right, bottom, top, or
                                             ///< of the outline
    unsigned int              particle = 0;  ///< the owner
    double                    length   = 0.; ///< [m]
    dealii::Point<2>          centre;        ///< [m]
    std::vector<unsigned int> index;
    std::vector<double>       weight; ///< integral of Phi_j [m]
    VectorField               flux;   ///< integral of Phi_j n [m]
  };

  /// The whole boundary of the body, seen from the owners.
  std::vector<BoundaryFacet>
  boundary_facets(const ShapeFunctions &shape);


  /// The two Gauss points of a facet.
  inline std::array<dealii::Point<2>, 2>
  gauss_points(const CellFacet &facet)
  {
    const double               s = 0.28867513459481288225; // 1/sqrt(12)
    const dealii::Tensor<1, 2> d = facet.second - facet.first;
    return {{facet.first + (0.5 - s) * d, facet.first + (0.5 + s) * d}};
  }
} // namespace Morsel::SPH

#endif
