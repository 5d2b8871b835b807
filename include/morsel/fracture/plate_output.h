#ifndef morsel_fracture_plate_output_h
#define morsel_fracture_plate_output_h

#include <morsel/fracture/elastic_plane.h>
#include <morsel/fracture/plate_scene.h>
#include <morsel/fracture/tip_fields.h>
#include <morsel/fracture/tip_result.h>

#include <functional>
#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// Displacement and gradient of a method's solution at points of the plate.
  using FieldSampler = std::function<std::vector<DisplacementSample>(
      const std::vector<dealii::Point<2>> &points)>;


  /// K_I, K_II and J of every ring of every tip as a table (csv), with the
  /// tip's place and direction and the ring's radii.
  std::string
  stress_intensity_csv(const std::vector<CrackTip>  &tips,
                       const std::vector<TipResult> &results);


  /// How far the crack's faces are apart behind every tip, as a table (csv):
  /// opening and sliding over the distance along the crack, and beside them
  /// the asymptotic law 8 K/E' sqrt(r/(2 pi)) with the K measured. Between
  /// two tips each half belongs to the nearer one.
  std::string
  crack_opening_csv(const PlateScene             &plate,
                    const std::vector<Crack>     &cracks,
                    const std::vector<TipResult> &results,
                    const FieldSampler           &sample);


  /// Stress about every tip in polar components, as a table (csv): ahead of
  /// the tip up to the largest ring (angle 0), and on circles up to 0.4 of its
  /// outer radius; beside it the singular field of the K measured.
  std::string
  tip_stress_csv(const PlateScene             &plate,
                 const std::vector<CrackTip>  &tips,
                 const std::vector<TipResult> &results,
                 const FieldSampler           &sample);


  /// The inner and outer circle of every ring as lines of a ParaView file,
  /// with tip, K_I, K_II and J.
  std::string
  rings_vtu(const std::vector<CrackTip>  &tips,
            const std::vector<TipResult> &results);


  /// The cracks as lines of a ParaView file, cut off at the plate's boundary.
  std::string
  cracks_vtu(const PlateScene &plate, const std::vector<Crack> &cracks);
} // namespace Morsel::Fracture

#endif
