#ifndef morsel_source_tooth_cracks_h
#define morsel_source_tooth_cracks_h

#include <morsel/fe/elastic_body.h>
#include <morsel/scene/scene.h>

namespace Morsel
{
  /// The cracks that the scene gives to an elastic body.
  /// @throws InputError naming the entry for cracks outside or along its
  ///   boundary, from boundary to boundary, of no length, or touching
  FE::ElasticBodyCracks
  cracks_of(const Scene::PlateBody &plate);
} // namespace Morsel

#endif
