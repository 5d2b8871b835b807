#ifndef morsel_sph_cloud_h
#define morsel_sph_cloud_h

#include <morsel/fracture/crack.h>
#include <morsel/sph/voronoi.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Morsel::SPH
{
  /// How a rectangle is filled with particles.
  struct Filling
  {
    dealii::Point<2> lower, upper; ///< [m]
    unsigned int     n_x = 0, n_y = 0;
    /// Rows along the cracks take the place of the lattice near them, so that
    /// cracks run between two rows and end at a corner of cells.
    bool         fit_to_cracks = true;
    double       scatter       = 0.; ///< largest random offset [spacings]
    unsigned int seed          = 1;
  };


  /// Particles in a body with their Voronoi cells.
  struct Cloud
  {
    dealii::Point<2>              lower, upper; ///< of the bounding box [m]
    double                        spacing = 0.; ///< dp [m]
    std::vector<dealii::Point<2>> points;       ///< X [m]
    std::vector<VoronoiCell>      cells;
    unsigned int                  n_relaxations = 0; ///< Lloyd iterations

    unsigned int
    size() const
    {
      return points.size();
    }
  };


  /// A lattice half a spacing inside of the rectangle, fitted to the cracks
  /// and scattered as asked for. Where the cloud is fitted, the two rows along
  /// a crack are scattered as mirror images of each other, and so are the two
  /// columns about a tip: the crack stays on facets and ends at a corner.
  /// @throws InputError if a particle would lie on a crack
  Cloud
  fill_rectangle(const Filling                      &filling,
                 const std::vector<Fracture::Crack> &cracks);
} // namespace Morsel::SPH

#endif
