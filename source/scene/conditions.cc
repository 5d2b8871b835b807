#include <morsel/scene/conditions.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Scene
{
  namespace Patterns = dealii::Patterns;

  void
  Condition::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Body", body, "The particle body concerned; the first one if empty.");
    prm.add_parameter(
        "Where",
        where,
        "A side of the body's shape (of a rectangle 'left', 'right', 'bottom' "
        "or 'top'), the particles in the 'box', or 'everywhere'.");
    prm.add_parameter("Lower corner",
                      box.lower_corner,
                      "Of the box, 'x, y' in the reference configuration [m]; "
                      "with a side: only its part in the box.");
    prm.add_parameter(
        "Upper corner", box.upper_corner, "Of the box, 'x, y' [m].");
    prm.add_parameter(
        "Kind",
        kind,
        "'clamp' (no motion), 'roller' (none across the side), 'velocity' "
        "[m/s], 'displacement' [m], 'traction' on a side [Pa], 'pressure' on a "
        "side (Value = 'p; s': p into the body, s along the side with the body "
        "on the left [Pa]), 'force' in all [N], 'acceleration' [m/s^2], or "
        "'damping' (a force -rate times momentum, Value = 'rate; rate' [1/s]). "
        "Transients take velocities and dampings, static solutions "
        "displacements.",
        Patterns::Selection("clamp|roller|velocity|displacement|traction|"
                            "pressure|force|acceleration|damping"));
    prm.add_parameter("Components",
                      components,
                      "Which components of a velocity or displacement are "
                      "prescribed.",
                      Patterns::Selection("x and y|x|y"));
    prm.add_parameter("Value",
                      value,
                      "'f_x; f_y' as expressions of the present position x, y "
                      "[m] and time t [s], in the unit of the kind.");
  }


  Condition::Side
  Condition::side() const
  {
    return where == "left"     ? Side::left
           : where == "right"  ? Side::right
           : where == "bottom" ? Side::bottom
           : where == "top"    ? Side::top
                               : Side::none;
  }


  dealii::Tensor<1, 2>
  Condition::traction(const dealii::Tensor<1, 2> &given,
                      const dealii::Tensor<1, 2> &normal) const
  {
    if (kind != "pressure")
      return given;
    const dealii::Tensor<1, 2> along({-normal[1], normal[0]});
    return -given[0] * normal + given[1] * along;
  }


  bool
  Condition::prescribes(const unsigned int d) const
  {
    if (kind == "clamp")
      return true;
    if (kind == "roller")
      return d == (side() == Side::left || side() == Side::right ? 0 : 1);
    return (kind == "velocity" || kind == "displacement") &&
           (components == "x and y" || components == (d == 0 ? "x" : "y"));
  }


  void
  Observer::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Body", body, "The particle body concerned; the first one if empty.");
    prm.add_parameter("Point",
                      point,
                      "Point 'x, y' of the body in the reference configuration "
                      "[m]; edges count, too.");
    prm.add_parameter("Frequency of",
                      frequency,
                      "The component of displacement whose frequency is "
                      "measured by its passages through zero.",
                      Patterns::Selection("none|x|y"));
    prm.add_parameter("Expected displacement",
                      expected_displacement,
                      "'u_x, u_y' at the end [m], where it is known.");
    prm.add_parameter("Expected stress",
                      expected_stress,
                      "'xx, yy, xy' at the end [Pa], where it is known.");
    prm.add_parameter("Expected frequency",
                      expected_frequency,
                      "[Hz], where it is known; 0: unknown.",
                      Patterns::Double(0.));
  }
} // namespace Morsel::Scene
