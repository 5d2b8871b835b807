#include <morsel/core/errors.h>
#include <morsel/sph/shape_functions.h>

#include <cmath>
#include <sstream>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    constexpr double largest_stretch = 2.;

    /// Smallest determinant of the moment matrix in units of h that still
    /// fits a line: about 0.05 inside a lattice.
    constexpr double smallest_determinant = 1e-4;
  } // namespace


  ShapeFunctions::ShapeFunctions(const Cloud      &cloud,
                                 const Kernel     &kernel,
                                 const Visibility &visibility)
      : cloud(cloud)
      , kernel(kernel)
      , visibility(visibility)
  {
    grid.build(cloud.points, largest_stretch * kernel.support());
  }


  bool
  ShapeFunctions::fit(const Point<2> &eye,
                      const Point<2> &x,
                      const double    stretch,
                      ShapeValues    &values) const
  {
    values.index.clear();
    values.value.clear();
    const double reach = stretch * kernel.support();
    // Moments of (1, (X_j - x)/h) with the weights V_j W_j.
    double m00 = 0., m01 = 0., m02 = 0., m11 = 0., m12 = 0., m22 = 0.;
    grid.for_each_near(x, [&](const unsigned int j) {
      const Tensor<1, 2> d = cloud.points[j] - x;
      if (d.norm_square() >= reach * reach)
        return;
      const double r = visibility.distance(eye, x, cloud.points[j]);
      const double w = cloud.cells[j].area * kernel.value(r / stretch);
      if (w <= 0.)
        return;
      const double a = d[0] / kernel.h, b = d[1] / kernel.h;
      values.index.push_back(j);
      values.value.push_back(w);
      m00 += w;
      m01 += w * a;
      m02 += w * b;
      m11 += w * a * a;
      m12 += w * a * b;
      m22 += w * b * b;
    });
    const double c0          = m11 * m22 - m12 * m12;
    const double c1          = m02 * m12 - m01 * m22;
    const double c2          = m01 * m12 - m02 * m11;
    const double determinant = m00 * c0 + m01 * c1 + m02 * c2;
    if (!(determinant > smallest_determinant * m00 * m00 * m00))
      return false;
    for (unsigned int k = 0; k < values.index.size(); ++k)
      {
        const Tensor<1, 2> d = cloud.points[values.index[k]] - x;
        values.value[k] *=
            (c0 + (c1 * d[0] + c2 * d[1]) / kernel.h) / determinant;
      }
    return true;
  }


  void
  ShapeFunctions::evaluate(const Point<2> &eye,
                           const Point<2> &x,
                           ShapeValues    &values) const
  {
    for (double stretch = 1.; stretch <= largest_stretch; stretch *= 1.25)
      if (fit(eye, x, stretch, values))
        return;
    std::ostringstream message;
    message << "Too few particles are seen from (" << eye
            << ") m to fit a displacement at (" << x
            << ") m: give more particles, or keep cracks further apart.";
    throw NumericalError(message.str());
  }
} // namespace Morsel::SPH
