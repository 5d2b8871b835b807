#ifndef morsel_sph_visibility_h
#define morsel_sph_visibility_h

#include <morsel/fracture/crack.h>

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


  /// How far two places are from each other in a cracked body.
  class Visibility
  {
  public:
    static constexpr double hidden = 1e300;

    /// @param reach support radius of the kernel [m]
    Visibility(const std::vector<Morsel::Fracture::Crack> &cracks,
               const TipHandling                           handling,
               const double                                reach);

    /// Whether the straight line crosses no crack. A line through a tip
    /// crosses none.
    bool
    sees(const dealii::Point<2> &p, const dealii::Point<2> &q) const;

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
    std::vector<Morsel::Fracture::Crack>    cracks;
    std::vector<Morsel::Fracture::CrackTip> tips;
    TipHandling                             handling;
    double                                  reach;
  };
} // namespace Morsel::SPH

#endif
