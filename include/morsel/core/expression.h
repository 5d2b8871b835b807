#ifndef morsel_core_expression_h
#define morsel_core_expression_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>

namespace Morsel
{
  /// A vector field in the plane, written as "f_x; f_y" in the variables x, y
  /// and t (and pi) with the functions of muParser: "0; 1e3*min(t/0.01, 1)".
  class VectorExpression
  {
  public:
    /// @throws InputError with one sentence that says what is wrong.
    explicit VectorExpression(const std::string &text);

    ~VectorExpression();

    VectorExpression(VectorExpression &&) noexcept;
    VectorExpression &
    operator=(VectorExpression &&) noexcept;

    dealii::Tensor<1, 2>
    operator()(const dealii::Point<2> &x, double time) const;

    /// Whether it is the same everywhere.
    bool
    is_uniform() const
    {
      return uniform;
    }

  private:
    struct Parser;
    bool                    uniform;
    std::unique_ptr<Parser> parser;
  };
} // namespace Morsel

#endif
