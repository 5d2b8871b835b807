#include <morsel/calibrate/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Calibrate
{
  namespace Patterns = dealii::Patterns;

  void
  CalibrationParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Compressive strength",
                      compressive_strength,
                      "What --calibrate shall reach with Damage/Threshold "
                      "factor [Pa]; 0: the material's compressive strength.",
                      Patterns::Double(0.));
    prm.add_parameter("Compression result",
                      compression_result,
                      "Result of this scene that measures it: a name in "
                      "summary.json, or a formula of such names [Pa].");
    prm.add_parameter("Tensile strength",
                      tensile_strength,
                      "What --calibrate shall reach with Damage/Strength "
                      "ratio [Pa]; 0: the ratio is not calibrated.",
                      Patterns::Double(0.));
    prm.add_parameter("Tension scene",
                      tension_scene,
                      "Scene that measures the tensile strength, relative to "
                      "this file; it is run with the material and the damage "
                      "of this scene.");
    prm.add_parameter("Tension result",
                      tension_result,
                      "Result of that scene: a name, or a formula [Pa].");
    prm.add_parameter("Particles across",
                      particles_across,
                      "Resolution of the runs of this scene [1]; 0: its own.",
                      Patterns::Integer(0));
    prm.add_parameter("Seeds",
                      seeds,
                      "Number of seeds, from that of the scene on; what counts "
                      "is the mean [1].",
                      Patterns::Integer(1, 1000));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Largest relative error of the mean strength [1].",
                      Patterns::Double(1e-5, 0.5));
    prm.add_parameter("Largest number of rounds",
                      rounds,
                      "A round is one run for each seed and scene [1].",
                      Patterns::Integer(1, 100));
    prm.add_parameter("Side by side",
                      side_by_side,
                      "Runs at the same time [1]; 0: as many as there are "
                      "cores.",
                      Patterns::Integer(0, 4096));
    prm.add_parameter("Time limit",
                      time_limit,
                      "A run that takes longer has failed [s]; 0: none.",
                      Patterns::Double(0.));
  }
} // namespace Morsel::Calibrate
