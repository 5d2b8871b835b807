#ifndef morsel_sph_visibility_h
#define morsel_sph_visibility_h

#include <morsel/fracture/crack.h>
#include <morsel/scene/outline.h>
#include <morsel/sph/neighbours.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Morsel::SPH
{
  /// What becomes of a pair whose line of sight crosses a crack.
  enum class TipHandling
  {
    /// It does not interact.
    visibility,
    /// It interacts over the way around the tip (Organ, Fleming, Terry and
    /// Belytschko 1996).
    diffraction,
    /// It interacts the less, the further from the tip the line crosses (the
    /// transparency method of the same authors).
    transparency
  };

  TipHandling
  tip_handling_named(const std::string &name);


  /// Walls sorted into square cells, so that a line of sight meets few.
  class WallGrid
  {
  public:
    WallGrid(const std::vector<Scene::Outline::Edge> &edges,
             const double                             cell_size);

    bool
    empty() const
    {
      return walls.empty();
    }

    /// Whether the straight line crosses a wall.
    bool
    separates(const dealii::Point<2> &p, const dealii::Point<2> &q) const;

  private:
    /// Calls f(list of walls) for the cells that a bounding box overlaps,
    /// until it returns true.
    template <typename Lists, typename Function>
    bool
    any_cell(Lists                  &lists,
             const dealii::Point<2> &p,
             const dealii::Point<2> &q,
             const Function         &f) const;

    std::vector<Fracture::Crack>           walls;
    double                                 size;
    dealii::Point<2>                       origin;
    unsigned int                           n_x = 0, n_y = 0;
    std::vector<std::vector<unsigned int>> cells; ///< walls of each
  };


  /// How far two places are from each other in a cracked body.
  class Visibility
  {
  public:
    static constexpr double hidden = 1e300;

    /// Everything sees everything.
    Visibility()
        : Visibility({}, TipHandling::visibility, 1.)
    {}

    /// @param reach support radius of the kernel [m]
    /// @param walls edges of the body: lines of sight do not leave it
    Visibility(const std::vector<Fracture::Crack>      &cracks,
               const TipHandling                        handling,
               const double                             reach,
               const std::vector<Scene::Outline::Edge> &walls = {});

    /// Whether the straight line crosses neither crack nor wall. A line
    /// through a tip crosses no crack.
    bool
    sees(const dealii::Point<2> &p, const dealii::Point<2> &q) const;

    /// Whether some pair may not see each other.
    bool
    hides() const
    {
      return !cracks.empty() || !walls.empty();
    }

    /// Whether two neighbours are parts of one body: no crack runs between
    /// them, though a notch may stand in their sight.
    bool
    are_joined(const dealii::Point<2> &p, const dealii::Point<2> &q) const;

    /// The distance that the kernel takes [m]: that from @p x to @p node if
    /// @p eye sees the node, else what the tip handling makes of it, or
    /// hidden. A shape function on a facet of a cell is judged from the
    /// particle that owns it: seen from the facet, which a crack may cross,
    /// the crack would heal.
    double
    distance(const dealii::Point<2> &eye,
             const dealii::Point<2> &x,
             const dealii::Point<2> &node) const;

  private:
    std::vector<Fracture::Crack>    cracks;
    WallGrid                        walls;
    std::vector<Fracture::CrackTip> tips;
    TipHandling                     handling;
    double                          reach;
  };


  /// Leaves out the pairs that do not see each other in the reference
  /// configuration.
  /// @param reference X [m]
  void
  keep_visible(NeighbourList                       &list,
               const std::vector<dealii::Point<2>> &reference,
               const Visibility                    &visibility);


  /// A particle on a crack would belong to both of its faces.
  /// @param spacing of the particles [m]
  /// @throws InputError, ending with the @p advice
  void
  check_off_cracks(const std::vector<dealii::Point<2>> &particles,
                   const std::vector<Fracture::Crack>  &cracks,
                   const double                         spacing,
                   const std::string                   &advice);
} // namespace Morsel::SPH

#endif
