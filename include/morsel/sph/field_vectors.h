#ifndef morsel_sph_field_vectors_h
#define morsel_sph_field_vectors_h

#include <morsel/sph/discrete_gradient.h>

#include <deal.II/lac/vector.h>

#include <algorithm>

namespace Morsel::SPH
{
  /// A field as the vector x_0, y_0, x_1, ... of a solver, and back.
  inline VectorField
  to_field(const dealii::Vector<double> &x)
  {
    VectorField field(x.size() / 2);
    for (unsigned int i = 0; i < field.size(); ++i)
      field[i] = dealii::Tensor<1, 2>({x(2 * i), x(2 * i + 1)});
    return field;
  }


  inline dealii::Vector<double>
  to_vector(const VectorField &field)
  {
    dealii::Vector<double> x(2 * field.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x(i) = field[i / 2][i % 2];
    return x;
  }


  /// The largest magnitude.
  inline double
  largest(const VectorField &field)
  {
    double result = 0.;
    for (const dealii::Tensor<1, 2> &v : field)
      result = std::max(result, v.norm());
    return result;
  }
} // namespace Morsel::SPH

#endif
