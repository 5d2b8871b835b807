#ifndef morsel_sph_stiffness_elements_h
#define morsel_sph_stiffness_elements_h

#include <morsel/core/multifrontal_cholesky.h>
#include <morsel/core/records.h>
#include <morsel/fracture/elastic_plane.h>
#include <morsel/sph/discrete_gradient.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace Morsel::SPH
{
  /// The stiffness of a particle body as a sum of elements: particle i makes
  /// one with the neighbours of its discrete gradient and of its residual
  /// control,
  ///   2 E_i = V_i H_i : C : H_i + 1/2 sum_k k_ik |u_k - u_i|^2
  ///           - 1/2 P_i M_i^-1 : P_i,  P_i = sum_k k_ik (u_k - u_i) (x) X_ik,
  /// the least-squares fit written out.
  class StiffnessElements
  {
  public:
    StiffnessElements(const DiscreteGradient       &gradient,
                      const ResidualControl        &control,
                      const Fracture::ElasticPlane &material);

    /// Of element i, the particle i first.
    const ElementNodes &
    get_nodes() const
    {
      return nodes;
    }

    /// The lower triangle of element i by columns [Pa].
    void
    matrix(const unsigned int i, std::vector<double> &result) const;

    /// y = stiffness times x [N/m].
    void
    vmult(dealii::Vector<double> &y, const dealii::Vector<double> &x) const;

  private:
    /// What a node of an element weighs. That of the particle itself is such
    /// that rigid displacements do nothing.
    struct Entry
    {
      Vector2 gradient;  ///< G_ik [1/m]
      Vector2 moment;    ///< k_ik X_ik [Pa m]
      double  stiffness; ///< k_ik [Pa]
    };

    ElementNodes            nodes;
    std::vector<Entry>      entries;
    std::vector<double>     volume;
    std::vector<Symmetric2> inverse_moment; ///< M_i^-1
    double                  lambda, mu;
  };
} // namespace Morsel::SPH

#endif
