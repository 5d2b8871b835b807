#include <morsel/core/failure.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture_run.h>
#include <morsel/prediction.h>
#include <morsel/scene/read.h>
#include <morsel/simulation.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace Morsel
{
  namespace
  {
    /// Two significant digits, without an exponent.
    std::string
    two_digits(const double value)
    {
      std::ostringstream text;
      const double       size =
          value > 0. ? std::pow(10., std::floor(std::log10(value)) - 1.) : 1.;
      text << std::fixed << std::setprecision(value < 1. ? 2 : value < 10.)
           << std::round(value / size) * size;
      return text.str();
    }
  } // namespace


  void
  Prediction::count(const std::string &name, const double figure)
  {
    std::ostringstream text;
    if (figure >= 1.)
      text << std::fixed << std::setprecision(0);
    text << figure;
    counts.emplace_back(name, text.str());
  }


  std::string
  duration_text(const double seconds)
  {
    return seconds < 120.    ? two_digits(seconds) + " s"
           : seconds < 7200. ? two_digits(seconds / 60.) + " min"
                             : two_digits(seconds / 3600.) + " h";
  }


  std::string
  memory_text(const double bytes)
  {
    return bytes < 1e9 ? two_digits(1e-6 * bytes) + " MB"
                       : two_digits(1e-9 * bytes) + " GB";
  }


  std::string
  as_text(const Prediction &prediction)
  {
    std::ostringstream text;
    for (const std::string &advice : prediction.advice)
      text << "Advice: " << advice << '\n';
    text << "Scene '" << prediction.scene << "' is sound. Effects:\n"
         << prediction.effects << std::left;
    for (const auto &[name, figure] : prediction.counts)
      text << std::setw(17) << name << figure << '\n';
    text << "Predicted memory about " << std::llround(1e-6 * prediction.bytes)
         << " MB\nPredicted time   about " << std::setprecision(2)
         << two_digits(prediction.seconds) << " s (" << prediction.basis << "; "
         << two_digits(prediction.processor_seconds)
         << " s of processor time)\n";
    return text.str();
  }


  Prediction
  predict_scene(const std::string              &scene_file,
                const std::vector<std::string> &overrides)
  {
    if (!is_fracture_scene(scene_file, overrides))
      return predict_run(Scene::read_scene_on_all_ranks(scene_file, overrides));
    Prediction prediction;
    FirstRank().run(
        [&] { prediction = predict_fracture_scene(scene_file, overrides); });
    return prediction;
  }
} // namespace Morsel
