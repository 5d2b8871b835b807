#ifndef morsel_fracture_crack_paths_h
#define morsel_fracture_crack_paths_h

#include <morsel/fracture/crack.h>

#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// The body in which cracks lie.
  struct CrackedFrame
  {
    std::string      name;         ///< what messages call it
    dealii::Point<2> lower, upper; ///< its bounding box [m]
    /// Distance inside of its boundary, negative outside [m]; a rectangle's
    /// where there is none.
    std::function<double(const dealii::Point<2> &)> depth = {};

    /// Its diagonal [m].
    double
    size() const
    {
      return (upper - lower).norm();
    }

    double
    depth_inside(const dealii::Point<2> &p) const;

    /// How far mouths are carried on beyond the boundary, so that cracks cut
    /// the outermost cells through [m].
    double
    mouth_overhang() const
    {
      return 0.01 * size();
    }
  };


  /// "(x, y) m".
  std::string
  point_text(const dealii::Point<2> &p);


  /// Two numbers "x, y", both finite.
  /// @throws InputError naming the entry if the text is anything else
  dealii::Point<2>
  read_pair(const std::string &text, const std::string &entry);


  /// "x, y > x, y > ...; x, y > ..." [m].
  /// @throws InputError naming the entry
  std::vector<std::vector<dealii::Point<2>>>
  read_crack_paths(const std::string &text, const std::string &entry);


  /// A crack for each path: an end on the boundary is a mouth, any other a
  /// tip. Mouths are carried on beyond the boundary.
  /// @throws InputError for a crack outside or along the boundary, of no
  ///   length, or touching another one or itself
  std::vector<Crack>
  cracks_in(const CrackedFrame                               &frame,
            const std::vector<std::vector<dealii::Point<2>>> &paths,
            const std::string                                &entry);
} // namespace Morsel::Fracture

#endif
