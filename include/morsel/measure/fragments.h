#ifndef morsel_measure_fragments_h
#define morsel_measure_fragments_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <cstdint>
#include <vector>

namespace Morsel::Measure
{
  /// One connected piece of food.
  struct Fragment
  {
    std::size_t      n_particles = 0;
    double           area        = 0.; ///< sum of its particles' areas [m^2]
    double           share       = 0.; ///< of the whole food's mass [1]
    double           perimeter   = 0.; ///< [m]
    dealii::Point<2> centroid;         ///< weighted by area [m]
  };


  /// What the food has broken into.
  struct Fragments
  {
    /// Per particle: the index into pieces, or -1 for dust (failed).
    std::vector<int> label;

    /// All pieces, the largest first; equal ones in the order of their first
    /// particle.
    std::vector<Fragment> pieces;

    /// So many of the pieces, the first ones, reach the share that makes a
    /// fragment. The others are crumbs.
    unsigned int count = 0;

    double crumb_share = 0.; ///< mass in pieces below that share [1]
    double dust_share  = 0.; ///< mass of failed particles [1]

    /// Share of the largest fragment [1], 0 if there is none.
    double
    largest_share() const;
  };


  /// Neighbours of each particle in compressed rows: those of particle i are
  /// neighbour[first[i]], ..., neighbour[first[i + 1] - 1]. A pair may be
  /// listed once or twice.
  struct BondList
  {
    std::vector<std::uint64_t> first; ///< n + 1 entries
    std::vector<std::uint32_t> neighbour;
  };


  /// All pairs no further apart than the distance, each listed once; by a
  /// grid of cells, with work proportional to the number of particles.
  ///
  /// @param positions [m]; reference positions, if friends of old are meant.
  /// @param distance [m], larger than 0.
  BondList
  friends(const dealii::ArrayView<const dealii::Point<2>> positions,
          const double                                    distance);


  /// The connected components of the particles that are alive, over the bonds
  /// between them (friends-of-friends).
  ///
  /// @param alive nonzero for D < 1; what has failed is dust and carries the
  ///   label -1.
  /// @param bonds those that hold: broken ones are left out by the caller.
  /// @param positions those whose perimeters and centroids are wanted; with
  ///   reference positions, the perimeter is that of the piece before it was
  ///   deformed.
  /// @param areas of each particle [m^2]: volume over depth.
  /// @param spacing of the particles [m], see perimeter().
  /// @param fragment_share the smallest share of the mass that counts as a
  ///   fragment [1].
  ///
  /// The density is uniform: shares of mass are shares of area. Perimeters of
  /// crumbs are not evaluated (0).
  Fragments
  find_fragments(const dealii::ArrayView<const char>             alive,
                 const BondList                                 &bonds,
                 const dealii::ArrayView<const dealii::Point<2>> positions,
                 const dealii::ArrayView<const double>           areas,
                 const double                                    spacing,
                 const double fragment_share);
} // namespace Morsel::Measure

#endif
