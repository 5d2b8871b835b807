#include <morsel/jaw/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Jaw
{
  namespace Patterns = dealii::Patterns;

  void
  DeformationParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Deformation");
    prm.add_parameter(
        "Response",
        response,
        "How the body answers the food: 'rigid', 'quasi-static' (elastic "
        "without inertia, in equilibrium with the contact forces at every "
        "step), 'dynamic' (elastic with inertia, implicit, so that its "
        "wave speed does not set the step) or 'auto': rigid if it gives way by "
        "less than the tolerance, quasi-static if it answers within a tenth "
        "of the time to the food's failure, else dynamic; run.log says why.",
        Patterns::Selection("auto|rigid|quasi-static|dynamic"));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "'auto' takes a body for rigid if under a uniform "
                      "pressure of the food it yields by less than this share "
                      "of what the food does [1].",
                      Patterns::Double(0., 1.));
    prm.add_parameter(
        "Held sides",
        held_sides,
        "Sides that follow the motion, separated by commas: left, right, "
        "bottom, top of a rectangle, boundary ids of a mesh. With none the "
        "body is free, which only 'dynamic' can be.");
    prm.add_parameter("Cell size",
                      cell_size,
                      "Of a rectangle's mesh [m]; 0 takes an eighth of the "
                      "smaller side, but not less than two particle spacings.",
                      Patterns::Double(0.));
    prm.add_parameter("Degree",
                      degree,
                      "Polynomial degree of the displacement [1]. With 1 a "
                      "uniform pressure crosses the contact exactly.",
                      Patterns::Integer(1, 4));
    prm.add_parameter("Tip refinements",
                      tip_refinements,
                      "How often the cells about each crack tip are halved "
                      "[1].",
                      Patterns::Integer(0, 12));
    prm.add_parameter(
        "Newmark beta",
        beta,
        "Of 'dynamic' [1]. 0.25 keeps waves in the body best, but the mass of "
        "small cells on the springs of contact may shorten the step of all. "
        "With 0.5 the stiffness of a body that is held carries these springs, "
        "and the food keeps its own step. 0 takes 0.5 where that is so, else "
        "0.25.",
        Patterns::Double(0., 1.));
    prm.add_parameter("Initial velocity",
                      initial_velocity,
                      "Velocity 'v_x, v_y' at time 0 of a body that is not "
                      "held [m/s].");
    prm.leave_subsection();

    prm.enter_subsection("Material");
    prm.add_parameter("Density",
                      density,
                      "Density of the body [kg/m^3]. Enamel: 2900, dentine: "
                      "2100.",
                      Patterns::Double(0.));
    prm.add_parameter("Young's modulus",
                      youngs_modulus,
                      "Young's modulus E of the body [Pa]. Enamel: 80e9, "
                      "dentine: 18e9.",
                      Patterns::Double(0.));
    prm.add_parameter("Poisson's ratio",
                      poissons_ratio,
                      "Poisson's ratio of the body [1]. Enamel and dentine: "
                      "0.3.",
                      Patterns::Double(0., 0.4999));
    prm.add_parameter("Fracture toughness",
                      fracture_toughness,
                      "K_Ic, at which a crack of the body would grow "
                      "[Pa sqrt(m)]; needed where it has cracks. Enamel: about "
                      "1e6, dentine: 2e6.",
                      Patterns::Double(0.));
    prm.leave_subsection();
  }
} // namespace Morsel::Jaw
