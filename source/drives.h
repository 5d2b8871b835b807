#ifndef morsel_source_drives_h
#define morsel_source_drives_h

#include <morsel/jaw/drive.h>
#include <morsel/scene/scene.h>

#include <memory>
#include <vector>

namespace Morsel
{
  /// The drive of each plate of a scene; those that ride on the jaw share one.
  std::vector<std::shared_ptr<Jaw::Drive>>
  make_drives(const Scene::Scene &scene, MPI_Comm communicator);
} // namespace Morsel

#endif
