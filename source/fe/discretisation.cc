#include <morsel/fe/discretisation.h>

namespace Morsel::FE
{
  using namespace dealii;

  void
  Discretisation::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("XFEM");
    prm.add_parameter("Cells along x",
                      cells_x,
                      "Before any refinement [1].",
                      Patterns::Integer(2, 2000));
    prm.add_parameter("Cells along y",
                      cells_y,
                      "Before any refinement [1].",
                      Patterns::Integer(2, 2000));
    prm.add_parameter("Shift of lines along x",
                      line_shift[0],
                      "Moves the interior mesh lines, in cells [1].",
                      Patterns::Double(-0.9, 0.9));
    prm.add_parameter("Shift of lines along y",
                      line_shift[1],
                      "Moves the interior mesh lines, in cells [1].",
                      Patterns::Double(-0.9, 0.9));
    prm.add_parameter("Degree",
                      degree,
                      "Of displacement and jump [1].",
                      Patterns::Integer(1, 8));
    prm.add_parameter("Degree drop",
                      degree_drop,
                      "What the degree loses with each refinement level, "
                      "rounded down: grading in h and p [1].",
                      Patterns::Double(0., 4.));
    prm.add_parameter("Smallest degree",
                      smallest_degree,
                      "Where the degree's drop ends [1].",
                      Patterns::Integer(1, 8));
    prm.add_parameter("Tip degree",
                      tip_degree,
                      "Of the multipliers of the tip functions [1].",
                      Patterns::Integer(1, 8));
    prm.add_parameter("Enrichment radius",
                      enrichment_radius,
                      "About each tip [m]; 0: the vertices of the tip's own "
                      "cells.",
                      Patterns::Double(0.));
    prm.add_parameter(
        "Ramp", ramp, "Blend the tip functions out (corrected XFEM).");
    prm.add_parameter("Corner refinements",
                      corner_refinements,
                      "Geometric refinements towards the corners of clamped "
                      "sides, which are singular [1].",
                      Patterns::Integer(0, 30));
    prm.add_parameter("Tip refinements",
                      tip_refinements,
                      "Geometric refinements towards the tips [1].",
                      Patterns::Integer(0, 30));
    prm.add_parameter("Refinement layers",
                      layers,
                      "Cells nearer to such a point than this many of their "
                      "diameters are refined [1].",
                      Patterns::Double(0., 10.));
    prm.add_parameter("Adaptive steps",
                      adaptive_steps,
                      "Solve, estimate, refine this many times [1].",
                      Patterns::Integer(0, 50));
    prm.add_parameter("Refined share",
                      refined_share,
                      "Share of the cells that an adaptive step refines [1].",
                      Patterns::Double(0.01, 1.));
    prm.add_parameter("Solver",
                      solver,
                      "'multifrontal' (Cholesky by elements, on the first "
                      "rank), 'iterative' (conjugate gradients; for meshes "
                      "that do not fit one rank) or 'umfpack' (one rank).",
                      Patterns::Selection("multifrontal|iterative|umfpack"));
    prm.leave_subsection();
  }
} // namespace Morsel::FE
