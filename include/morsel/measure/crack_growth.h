#ifndef morsel_measure_crack_growth_h
#define morsel_measure_crack_growth_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/materials/elasticity.h>
#include <morsel/sph/solid.h>

#include <deal.II/base/point.h>

#include <optional>
#include <vector>

namespace Morsel::Measure
{
  /// Speed of Rayleigh waves along the free surface of a half space [m/s],
  /// the limit of a crack in mode I: the root of Rayleigh's equation
  /// (2 - v^2/cs^2)^2 = 4 sqrt(1 - v^2/cd^2) sqrt(1 - v^2/cs^2).
  double
  rayleigh_speed(const Materials::Elasticity &material);


  /// How a crack grows from one of its tips: it is what of the failed
  /// particles is connected with the tip, from one to the next of those that
  /// were neighbours. Its extension is the distance of its farthest particle
  /// from the tip, all in the reference configuration.
  class CrackGrowth
  {
  public:
    /// The solid is kept by reference.
    /// @param tip place of the initial tip [m]
    CrackGrowth(const SPH::Solid &solid, const dealii::Point<2> &tip);

    /// Takes in the owned particles that failed now. Collective.
    void
    follow(double time, const std::vector<unsigned int> &newly_failed);

    /// [m]
    double
    extension() const
    {
      return course.empty() ? 0. : course.back().extension;
    }

    /// When it began to grow [s].
    std::optional<double>
    start() const;

    /// Mean speed over the last stretch of ten spacings until @p time [m/s];
    /// 0 before the crack is that long.
    double
    speed(double time) const;

    /// The largest of these when the crack advanced [m/s].
    double
    largest_speed() const
    {
      return fastest;
    }

    /// Pieces of the crack beyond three quarters of its extension: one for a
    /// straight crack, two or more for one that has branched before.
    /// Collective.
    unsigned int
    branch_count() const;

    void
    exchange_state(StateArchive &state);

  private:
    struct Advance
    {
      double time, extension; ///< [s], [m]
    };

    /// Takes those of @p candidates into the crack that stand by it, and what
    /// of this rank's hangs together with them. @p farthest from the tip [m] is
    /// kept up. @return whether there were any
    bool
    take_in(const std::vector<unsigned int> &candidates, double &farthest);

    /// Whether particle @p i stands by the crack.
    bool
    touches(unsigned int i) const;

    const SPH::Solid      &solid;
    const dealii::Point<2> tip;
    std::vector<char>      is_crack; ///< of those that the rank knows
    std::vector<Advance>   course;
    double                 fastest = 0.;
  };
} // namespace Morsel::Measure

#endif
