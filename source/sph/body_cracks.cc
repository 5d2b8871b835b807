#include <morsel/fracture/crack_paths.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/visibility.h>

namespace Morsel::SPH
{
  std::vector<Fracture::Crack>
  cracks_of(const Scene::ParticleBody &body, const unsigned int seed)
  {
    if (body.cracks.paths.empty())
      return {};
    const std::string entry  = "Body " + body.name + "/Cracks/Paths";
    const auto        cracks = Fracture::cracks_in(
        {"body '" + body.name + "'",
                body.shape.lower_corner,
                body.shape.upper_corner},
        Fracture::read_crack_paths(body.cracks.paths, entry),
        entry);
    check_off_cracks(body.positions(seed),
                     cracks,
                     body.spacing,
                     "choose numbers of particles that put no row of body '" +
                         body.name +
                         "' there (even ones for a crack at mid height).");
    return cracks;
  }
} // namespace Morsel::SPH
