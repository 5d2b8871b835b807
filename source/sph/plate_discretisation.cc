#include <morsel/core/kernel.h>
#include <morsel/sph/plate_discretisation.h>

#include <deal.II/base/patterns.h>

namespace Morsel::SPH
{
  namespace Patterns = dealii::Patterns;

  void
  PlateDiscretisation::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("SPH");
    prm.add_parameter("Particles along x",
                      particles_x,
                      "Of the lattice, which stands half a spacing inside of "
                      "the plate [1].",
                      Patterns::Integer(6, 2000));
    prm.add_parameter("Particles along y",
                      particles_y,
                      "Of the lattice [1].",
                      Patterns::Integer(6, 2000));
    prm.add_parameter("Fit to cracks",
                      fit_to_cracks,
                      "Particles near a crack stand in rows along it, so that "
                      "it runs between two rows and ends at a corner of cells; "
                      "else the crack follows the nearest edges of cells.");
    prm.add_parameter("Scatter",
                      scatter,
                      "Largest random offset of a particle along x and y, in "
                      "spacings [1].",
                      Patterns::Double(0., 0.4));
    prm.add_parameter(
        "Seed", seed, "Of the random offsets [1].", Patterns::Integer(0));
    prm.add_parameter("Kernel",
                      kernel,
                      "Smoothing kernel: 'cubic B-spline' (T3-33), 'quadratic' "
                      "(T3-34), 'Wendland C2' or 'quintic spline'.",
                      Patterns::Selection(kernel_names));
    prm.add_parameter(
        "Smoothing ratio",
        smoothing_ratio,
        "Smoothing length over particle spacing, h/dp [1]; the support is 2 h, "
        "of the quintic spline 3 h.",
        Patterns::Double(0.9, 3.));
    prm.add_parameter(
        "Gradient",
        gradient,
        "'conforming': averaged over Voronoi cells (stabilised "
        "conforming nodal integration), exact on any cloud; else "
        "that of the kernel, as it is ('none'), normalised by "
        "T3-35 ('Shepard'), 'per axis' (Johnson and Beissel "
        "1996) or by the gradient 'matrix'.",
        Patterns::Selection("conforming|matrix|none|Shepard|per axis"));
    prm.add_parameter("Hourglass coefficient",
                      hourglass,
                      "Stiffness of the residual of the local linear fit, in "
                      "units of Young's modulus [1]; 0 switches it off.",
                      Patterns::Double(0., 100.));
    prm.add_parameter(
        "Tip handling",
        tip_handling,
        "Pairs whose line of sight crosses a crack: 'visibility' "
        "cuts them, 'diffraction' lets them act around the tip, "
        "'transparency' weakens them with the distance from it.",
        Patterns::Selection("visibility|diffraction|transparency"));
    prm.leave_subsection();
  }
} // namespace Morsel::SPH
