#ifndef morsel_source_tip_summary_h
#define morsel_source_tip_summary_h

#include <morsel/core/log.h>
#include <morsel/fracture/tip_result.h>
#include <morsel/output/summary.h>
#include <morsel/scene/scene.h>

#include <string>
#include <vector>

namespace Morsel
{
  constexpr const char *stress_intensity_unit = "Pa sqrt(m)";


  /// What follows names of results at each tip: nothing for the first tip of
  /// the first crack, "_tip1", "_crack1_tip0" for others.
  std::vector<std::string>
  tip_suffixes(const std::vector<Fracture::CrackTip> &tips);


  /// The same for the cracks of a body.
  /// @param named whether the body's name ends the suffixes
  std::vector<std::string>
  tip_suffixes(const std::vector<Fracture::Crack> &cracks,
               const Scene::ParticleBody          &body,
               const bool                          named);


  /// Expected K by tip [Pa sqrt(m)]; 0 or missing: none.
  struct TipReferences
  {
    const std::vector<double> &mode_I, &mode_II;
  };


  /// K_I and K_II with what is expected of them.
  void
  add_stress_intensity(Output::Summary           &summary,
                       const Fracture::TipResult &result,
                       const std::string         &suffix,
                       const TipReferences       &references);


  /// The same for all tips of a body; their remarks go to the log.
  void
  add_tips_of_body(Output::Summary                        &summary,
                   RunLog                                 &log,
                   const Scene::ParticleBody              &body,
                   const std::vector<Fracture::TipResult> &results,
                   const std::vector<std::string>         &suffixes);
} // namespace Morsel

#endif
