#include "tip_summary.h"
#include "run_summary.h"

#include "experiment_recorder.h"

#include <optional>

namespace Morsel
{
  namespace
  {
    std::optional<double>
    reference_of(const std::vector<double> &references, const unsigned int tip)
    {
      if (tip < references.size() && references[tip] != 0.)
        return references[tip];
      return std::nullopt;
    }
  } // namespace


  std::vector<std::string>
  tip_suffixes(const std::vector<Fracture::CrackTip> &tips)
  {
    std::vector<std::string> suffixes;
    unsigned int             number = 0;
    for (unsigned int t = 0; t < tips.size(); ++t)
      {
        const unsigned int crack = tips[t].crack;
        number = t > 0 && crack == tips[t - 1].crack ? number + 1 : 0;
        std::string suffix;
        if (crack > 0)
          suffix += "_crack" + std::to_string(crack);
        if (crack > 0 || number > 0)
          suffix += "_tip" + std::to_string(number);
        suffixes.push_back(suffix);
      }
    return suffixes;
  }


  void
  add_stress_intensity(Output::Summary           &summary,
                       const Fracture::TipResult &result,
                       const std::string         &suffix,
                       const TipReferences       &references)
  {
    const Fracture::StressIntensity k = result.statistics.mean;
    summary.add("stress_intensity_I" + suffix,
                k.mode_I,
                stress_intensity_unit,
                "K_I by interaction integral, mean over the rings",
                reference_of(references.mode_I, result.tip));
    summary.add("stress_intensity_II" + suffix,
                k.mode_II,
                stress_intensity_unit,
                "K_II by interaction integral, mean over the rings",
                reference_of(references.mode_II, result.tip));
  }


  std::vector<std::string>
  tip_suffixes(const std::vector<Fracture::Crack> &cracks,
               const Scene::ParticleBody          &body,
               const bool                          named)
  {
    auto suffixes = tip_suffixes(Fracture::collect_tips(cracks));
    if (named)
      for (std::string &suffix : suffixes)
        suffix += "_" + underscored(body.name);
    return suffixes;
  }


  void
  add_tips_of_body(Output::Summary                        &summary,
                   RunLog                                 &log,
                   const Scene::ParticleBody              &body,
                   const std::vector<Fracture::TipResult> &results,
                   const std::vector<std::string>         &suffixes)
  {
    for (unsigned int t = 0; t < results.size(); ++t)
      {
        add_stress_intensity(summary,
                             results[t],
                             suffixes[t],
                             {body.cracks.expected_I, body.cracks.expected_II});
        if (!results[t].remark.empty())
          log.warning(results[t].remark);
      }
  }
} // namespace Morsel
