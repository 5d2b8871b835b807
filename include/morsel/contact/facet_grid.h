#ifndef morsel_contact_facet_grid_h
#define morsel_contact_facet_grid_h

#include <morsel/contact/surface.h>

#include <array>
#include <vector>

namespace Morsel::Contact
{
  /// Facets of a surface by the squares that they may be felt from, so that
  /// looking for the facets near a point costs the same however many there
  /// are.
  class FacetGrid
  {
  public:
    /// @param reach up to which facets count as near [m]
    FacetGrid(const Surface &surface, double reach);

    /// Facets within reach of x, and some more, in ascending order.
    /// @return [first, last) of candidates()
    std::pair<unsigned int, unsigned int>
    near(const dealii::Point<2> &x) const;

    const std::vector<unsigned int> &
    candidates() const
    {
      return facets;
    }

  private:
    /// Of a place, which may lie outside.
    std::array<long, 2>
    square(const dealii::Point<2> &x) const;

    dealii::Point<2>          lower;
    double                    side; ///< of a square [m]
    std::array<long, 2>       n{{0, 0}};
    std::vector<unsigned int> first; ///< by square
    std::vector<unsigned int> facets;
  };
} // namespace Morsel::Contact

#endif
