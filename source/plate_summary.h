#ifndef morsel_plate_summary_h
#define morsel_plate_summary_h

#include <morsel/fracture/plate_scene.h>
#include <morsel/fracture/tip_fields.h>
#include <morsel/fracture/tip_result.h>
#include <morsel/output/summary.h>

#include <functional>
#include <string>
#include <vector>

namespace Morsel
{
  /// K_I, K_II, their spread over the rings, references and ratios for every
  /// crack tip, whatever method found them.
  void
  add_tips(Output::Summary                        &summary,
           const Fracture::PlateScene             &plate,
           const std::vector<Fracture::Crack>     &cracks,
           const std::vector<Fracture::TipResult> &results);


  /// Displacement and stress at the scene's observed points.
  /// @param sample gives displacement and gradient at any places
  void
  add_observed_points(
      Output::Summary                             &summary,
      const Fracture::PlateScene                  &plate,
      const std::function<std::vector<Fracture::DisplacementSample>(
          const std::vector<dealii::Point<2>> &)> &sample);


  /// sqrt(E' G) by the energy difference T3-47, with its bias in words.
  void
  add_energy_route(Output::Summary            &summary,
                   const Fracture::PlateScene &plate,
                   const double                stress_intensity);


  /// Title, versions, hash of the parameters, ranks, threads, peak memory;
  /// collective over all ranks.
  void
  add_provenance(Output::Summary            &summary,
                 const Fracture::PlateScene &plate,
                 const std::string          &used_parameters);
} // namespace Morsel

#endif
