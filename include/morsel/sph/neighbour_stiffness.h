#ifndef morsel_sph_neighbour_stiffness_h
#define morsel_sph_neighbour_stiffness_h

#include <morsel/fracture/elastic_plane.h>
#include <morsel/sph/shape_functions.h>

#include <Eigen/SparseCore>

#include <vector>

namespace Morsel::SPH
{
  /// The lower triangle of a stiffness matrix that couples particles with
  /// their Voronoi neighbours only: every particle makes a triangle of linear
  /// displacement with any two neighbours that follow each other around its
  /// cell, weighted with the area that belongs to their common corner. It is
  /// spectrally equivalent to the particles' own stiffness matrix, has the
  /// same rigid motions, and a tenth of its entries: its factors make a
  /// preconditioner.
  /// @return entries of dofs 2 i + component, some of them repeated [Pa]
  std::vector<Eigen::Triplet<double>>
  neighbour_stiffness(const ShapeFunctions         &shape,
                      const Fracture::ElasticPlane &material);
} // namespace Morsel::SPH

#endif
