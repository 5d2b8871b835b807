#ifndef morsel_fe_crack_functionals_h
#define morsel_fe_crack_functionals_h

#include <morsel/fe/stress_intensity.h>

#include <Eigen/Sparse>

#include <vector>

namespace Morsel::FE
{
  /// How the cracks of a body fare, as linear functionals of its displacement:
  /// K_I and K_II by the interaction integral, which is linear in the field,
  /// and the opening between the faces. Each is a row over the dofs that is
  /// built once, so that following a body over time costs a sparse product. The
  /// rows of K hold the same rings, quadrature and weights as evaluate_rings().
  class CrackFunctionals
  {
  public:
    /// @param ring_radius see choose_rings() [m]
    /// @param expansion   all dofs of the space from those that displacements
    ///   will be given in
    /// @throws InputError naming 'Cracks/Ring radius' if the ring does not fit
    CrackFunctionals(const XFEMSpace                   &space,
                     const Fracture::ElasticPlane      &material,
                     double                             ring_radius,
                     const Eigen::SparseMatrix<double> &expansion);

    const std::vector<Fracture::CrackTip> &
    get_tips() const
    {
      return tips;
    }

    /// Rings and remarks by tip, without values.
    const std::vector<TipResult> &
    get_rings() const
    {
      return rings;
    }

    /// Mean and spread over the rings, by tip.
    std::vector<Fracture::RingStatistics>
    stress_intensity(const Eigen::VectorXd &displacement) const;

    /// Smallest distance of the faces along all cracks, taken at their normal
    /// [m]; negative where they would overlap.
    double
    smallest_opening(const Eigen::VectorXd &displacement) const;

  private:
    std::vector<Fracture::CrackTip> tips;
    std::vector<TipResult>          rings;
    /// Row of tip, ring and mode: 2 (rings of former tips + ring) + mode.
    Eigen::SparseMatrix<double> intensity;
    Eigen::SparseMatrix<double> opening; ///< by place along the cracks
  };
} // namespace Morsel::FE

#endif
