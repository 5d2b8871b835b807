#ifndef morsel_plan_scene_sizes_h
#define morsel_plan_scene_sizes_h

#include <morsel/fracture/plate_scene.h>
#include <morsel/scene/scene.h>
#include <morsel/study/formula.h>

#include <string>
#include <utility>
#include <vector>

namespace Morsel::Plan
{
  /// What records and their formulas need to know of a scene.
  struct SceneSizes
  {
    std::string      name;
    std::string      kind; ///< "cracked plate"; empty where no record can fit
    std::string      obstacle; ///< why none can fit
    Study::Variables scene;    ///< [m]
    std::vector<std::pair<std::string, Study::Variables>> bodies; ///< [m]
  };


  /// "width", "height", "shorter" of both, and "length": the smallest over
  /// the tips of the length of the tip's segment (half of it where it has two
  /// tips), the tip's distance from the boundary and half that from other
  /// cracks, but at most a tenth of "shorter" [m].
  SceneSizes
  sizes_of_plate(const Fracture::PlateScene &plate);


  /// For each particle body "width" along x and "thickness", twice the area
  /// over the perimeter: of a long strip or a ring its thickness, of a square
  /// half a side [m]. Kinds are "static body", "body in motion" and "stroke".
  SceneSizes
  sizes_of_bodies(const Scene::Scene &scene);


  /// Of a scene file.
  /// @throws InputError
  SceneSizes
  read_sizes(const std::string              &scene_file,
             const std::vector<std::string> &overrides);
} // namespace Morsel::Plan

#endif
