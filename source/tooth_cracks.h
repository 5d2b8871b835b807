#ifndef morsel_source_tooth_cracks_h
#define morsel_source_tooth_cracks_h

#include <morsel/fe/elastic_body.h>
#include <morsel/scene/scene.h>

namespace Morsel
{
  /// The cracks that the scene gives to an elastic body.
  /// @param mesh of the body, before it is refined
  /// @throws InputError naming the entry for cracks outside or along its
  ///   boundary, from boundary to boundary, of no length, or touching
  FE::ElasticBodyCracks
  cracks_of(const Scene::PlateBody         &plate,
            const dealii::Triangulation<2> &mesh);
} // namespace Morsel

#endif
