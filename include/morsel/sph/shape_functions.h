#ifndef morsel_sph_shape_functions_h
#define morsel_sph_shape_functions_h

#include <morsel/core/kernel.h>
#include <morsel/sph/cloud.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/visibility.h>

#include <vector>

namespace Morsel::SPH
{
  /// The values of all shape functions that do not vanish at a point.
  struct ShapeValues
  {
    std::vector<unsigned int> index;
    std::vector<double>       value; ///< [1]
  };


  /// Linear reproducing-kernel shape functions on a cloud (Liu, Jun and Zhang
  /// 1995): Phi_j(x) = V_j W_j (c_0 + c . (X_j - x)) with c such that sums
  /// over j reproduce every linear field. The values are those of the moving
  /// least-squares fit of a line at x.
  class ShapeFunctions
  {
  public:
    /// The cloud and the visibility are kept by reference.
    /// @param kernel of support no larger than the visibility's reach
    ShapeFunctions(const Cloud      &cloud,
                   const Kernel     &kernel,
                   const Visibility &visibility);

    /// Values at @p x of the nodes that @p eye sees. Where they are too few
    /// to fit a line, the kernel is widened.
    /// @throws NumericalError if there are not three such nodes off a line
    void
    evaluate(const dealii::Point<2> &eye,
             const dealii::Point<2> &x,
             ShapeValues            &values) const;

    const Cloud &
    get_cloud() const
    {
      return cloud;
    }

    const Kernel &
    get_kernel() const
    {
      return kernel;
    }

    const Visibility &
    get_visibility() const
    {
      return visibility;
    }

  private:
    bool
    fit(const dealii::Point<2> &eye,
        const dealii::Point<2> &x,
        const double            stretch,
        ShapeValues            &values) const;

    const Cloud      &cloud;
    Kernel            kernel;
    const Visibility &visibility;
    CellGrid          grid;
  };
} // namespace Morsel::SPH

#endif
