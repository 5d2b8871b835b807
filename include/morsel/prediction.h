#ifndef morsel_prediction_h
#define morsel_prediction_h

#include <string>
#include <utility>
#include <vector>

namespace Morsel
{
  /// What a run of a scene would be, found without running it.
  struct Prediction
  {
    std::string              scene;   ///< its name
    std::string              effects; ///< a line for each
    std::vector<std::string> advice;
    /// Names and figures of what is counted, in the order of printing.
    std::vector<std::pair<std::string, std::string>> counts;

    double      unknowns = 0.; ///< at the end of the run [1]
    double      steps    = 1.; ///< of time or of adaptivity [1]
    double      seconds  = 0.; ///< wall time from the start of the program [s]
    double      processor_seconds = 0.; ///< of all threads [s]
    double      bytes             = 0.; ///< largest resident set of a rank [B]
    std::string basis;                  ///< what the time rests on

    /// @param figure of at least 1 is rounded to a whole number
    void
    count(const std::string &name, double figure);
  };


  /// What --validate prints.
  std::string
  as_text(const Prediction &prediction);


  /// "0.35 s", "12 s", "3.4 min", "2.1 h".
  std::string
  duration_text(double seconds);

  /// "180 MB", "2.4 GB".
  std::string
  memory_text(double bytes);


  /// Reads and checks the scene and predicts its run on this machine, now:
  /// from trial steps that are thrown away, or from recorded costs and a
  /// calibration; collective over all ranks, complete on the first one.
  /// @throws InputError for whatever the run would refuse
  Prediction
  predict_scene(const std::string              &scene_file,
                const std::vector<std::string> &overrides);
} // namespace Morsel

#endif
