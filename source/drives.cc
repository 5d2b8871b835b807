#include "drives.h"

namespace Morsel
{
  std::vector<std::shared_ptr<Jaw::Drive>>
  make_drives(const Scene::Scene &scene, const MPI_Comm communicator)
  {
    std::vector<std::shared_ptr<Jaw::Drive>> drives;
    std::shared_ptr<Jaw::Drive>              jaw;
    for (const auto &plate : scene.plate_bodies)
      if (plate.motion.kind == "jaw")
        {
          if (!jaw)
            jaw = std::make_shared<Jaw::HingeDrive>(
                scene.jaw, scene.muscles, communicator);
          drives.push_back(jaw);
        }
      else if (plate.motion.kind == "force")
        drives.push_back(
            std::make_shared<Jaw::ForceDrive>(plate.motion, communicator));
      else
        drives.push_back(std::make_shared<Jaw::PrescribedDrive>(plate.motion));
    return drives;
  }
} // namespace Morsel
