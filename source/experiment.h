#ifndef morsel_source_experiment_h
#define morsel_source_experiment_h

#include <morsel/core/log.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/measure/energy_ledger.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/applied_conditions.h>
#include <morsel/sph/deformable_body.h>

#include <memory>
#include <vector>

namespace Morsel
{
  /// The mechanical system of a scene without plates: particle bodies in
  /// their formulations with supports, loads and prescribed motions, and one
  /// step of it.
  class Experiment
  {
  public:
    /// @throws InputError on several ranks.
    Experiment(const Scene::Scene &scene, RunLog &log);

    /// Forces and accounts at the present positions.
    void
    evaluate();

    /// Everything moves on to the next time.
    void
    advance();

    double
    time() const
    {
      return now;
    }

    double
    time_step() const
    {
      return dt;
    }

    unsigned long long
    step() const
    {
      return steps;
    }

    /// Everything in joules at the last evaluate().
    Measure::Energies
    energies() const;

    dealii::Tensor<1, 2>
    momentum() const;

    /// Impulses of the conditions [N s].
    std::vector<dealii::Tensor<1, 2>>
    impulses() const;

    /// What a condition of the scene gives to its body now [N].
    Vector2
    force(unsigned int condition) const;

    /// @throws NumericalError naming the first particle that is not finite.
    void
    check_finite() const;

    const std::vector<std::unique_ptr<SPH::DeformableBody>> &
    bodies() const
    {
      return solids;
    }

    /// The place of a body in the scene.
    unsigned int
    index_of(const std::string &body) const;

    unsigned long long
    particle_count() const;

    /// Saves or loads everything that changes, between advance() and the next
    /// evaluate().
    void
    exchange_state(StateArchive &state);

  private:
    const Scene::Scene &scene;
    RunLog             &log;

    std::vector<std::unique_ptr<SPH::DeformableBody>> solids;
    std::vector<SPH::AppliedConditions>               conditions;

    double             dt    = 0.;
    double             now   = 0.;
    unsigned long long steps = 0;
  };
} // namespace Morsel

#endif
