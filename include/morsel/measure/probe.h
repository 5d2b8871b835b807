#ifndef morsel_measure_probe_h
#define morsel_measure_probe_h

#include <morsel/core/state_archive_fwd.h>
#include <morsel/materials/elasticity.h>
#include <morsel/sph/deformable_body.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Morsel::Measure
{
  /// A material point of a particle body: values there are those of the
  /// plane fitted to the particles around it in the reference configuration
  /// (weighted least squares), which is exact for linear fields and reaches
  /// up to the edge. Collective.
  class Probe
  {
  public:
    /// The body is kept by reference.
    Probe(const SPH::DeformableBody &body, const dealii::Point<2> &point);

    Vector2
    displacement() const;

    Vector2
    velocity() const;

    Materials::PlaneStrainStress
    stress() const;

  private:
    struct Weight
    {
      unsigned int particle;
      double       value;
    };

    template <typename Value>
    Vector2
    sum(const Value &value) const;

    const SPH::DeformableBody *body;
    std::vector<Weight>        weights; ///< of this rank's particles
  };


  /// Frequency of an oscillation about zero, from its first to its last
  /// passage.
  class Passages
  {
  public:
    void
    add(double time, double value);

    /// Whole periods seen.
    double
    periods() const
    {
      return count > 0 ? 0.5 * (count - 1) : 0.;
    }

    /// [1/s]; 0 where less than half a period was seen.
    double
    frequency() const
    {
      return count > 1 ? periods() / (last - first) : 0.;
    }

    void
    exchange_state(StateArchive &state);

  private:
    bool         begun     = false;
    double       last_time = 0., last_value = 0.;
    unsigned int count = 0;
    double       first = 0., last = 0.;
  };
} // namespace Morsel::Measure

#endif
