#ifndef morsel_tests_cracked_plate_h
#define morsel_tests_cracked_plate_h

#include <morsel/fe/plate_problem.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <string>

namespace Morsel::FE
{
  inline constexpr double load = 1e3; ///< [Pa]


  /// M1: an edge crack of length a in a plate of width 10 mm. Variants: a
  /// clamped, b traction on both ends, c rollers.
  inline PlateParameters
  edge_crack(const char   variant = 'a',
             const double a       = 1e-3,
             const double H       = 1e-2)
  {
    PlateParameters p;
    p.upper_corner = dealii::Point<2>(1e-2, H);
    p.cells_y      = std::lround(13 * H / 1e-2);
    p.paths = "0, " + std::to_string(H / 2) + " > " + std::to_string(a) + ", " +
              std::to_string(H / 2);
    p.traction[3] = "0, 1000";
    if (variant == 'a')
      p.support[2] = "clamp";
    else if (variant == 'b')
      p.traction[2] = "0, -1000";
    else
      p.support[2] = "roller";
    return p;
  }


  /// M2: a centre crack of half length 0.5 mm.
  inline PlateParameters
  centre_crack(const char variant, const double angle)
  {
    PlateParameters p = edge_crack(variant);
    p.crack_form      = "inclined";
    p.angle           = angle;
    return p;
  }


  /// The one setting of the reference table.
  inline void
  use_table_setting(PlateParameters &p)
  {
    p.degree            = 4;
    p.tip_degree        = 3;
    p.enrichment_radius = 3.5e-4;
    p.tip_refinements   = 2;
  }


  inline PlateResults
  solve(const PlateParameters &parameters)
  {
    dealii::Triangulation<2> triangulation(
        dealii::Triangulation<2>::limit_level_difference_at_vertices);
    PlateProblem problem(parameters, make_cracks(parameters), triangulation);
    return problem.run();
  }


  /// K_I of the first tip over sigma sqrt(pi a).
  inline double
  relative_K(const PlateParameters &parameters, const double a = 1e-3)
  {
    return solve(parameters).tips[0].statistics.mean.mode_I /
           (load * std::sqrt(dealii::numbers::PI * a));
  }
} // namespace Morsel::FE

#endif
