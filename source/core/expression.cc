#include <morsel/core/errors.h>
#include <morsel/core/expression.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <iostream>
#include <regex>
#include <sstream>

namespace Morsel
{
  struct VectorExpression::Parser
  {
    mutable dealii::FunctionParser<2> function{2};
  };


  VectorExpression::VectorExpression(const std::string &text)
      : uniform(!std::regex_search(text, std::regex("\\b[xy]\\b")))
      , parser(std::make_unique<Parser>())
  {
    const std::string advice =
        " is not a vector field 'f_x; f_y' of x, y and t, such as '0; "
        "1e3*min(t/0.01, 1)'";
    if (std::count(text.begin(), text.end(), ';') != 1)
      throw InputError("'" + text + "'" + advice);
    // deal.II tells the terminal what muParser says, in lines of its own; the
    // one sentence below serves the user.
    std::ostringstream    unheard;
    std::streambuf *const terminal = std::cerr.rdbuf(unheard.rdbuf());
    bool                  good     = true;
    try
      {
        parser->function.initialize(
            "x,y,t", text, {{"pi", dealii::numbers::PI}}, true);
        (*this)(dealii::Point<2>(), 0.);
      }
    catch (const dealii::ExceptionBase &)
      {
        good = false;
      }
    std::cerr.rdbuf(terminal);
    if (!good)
      throw InputError("'" + text + "'" + advice);
  }


  VectorExpression::~VectorExpression() = default;


  VectorExpression::VectorExpression(VectorExpression &&) noexcept = default;


  VectorExpression &
  VectorExpression::operator=(VectorExpression &&) noexcept = default;


  dealii::Tensor<1, 2>
  VectorExpression::operator()(const dealii::Point<2> &x,
                               const double            time) const
  {
    dealii::Vector<double> v(2);
    parser->function.set_time(time);
    parser->function.vector_value(x, v);
    dealii::Tensor<1, 2> result;
    result[0] = v[0];
    result[1] = v[1];
    return result;
  }
} // namespace Morsel
