#ifndef morsel_source_experiment_h
#define morsel_source_experiment_h

#include "guards.h"
#include "run_state.h"

#include <morsel/core/log.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/core/step_clock.h>
#include <morsel/measure/energy_ledger.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/applied_conditions.h>
#include <morsel/sph/deformable_body.h>
#include <morsel/sph/solid.h>

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
    /// @param partition of the particle bodies, see ParticleHost
    /// @throws InputError for what one rank alone can simulate.
    Experiment(const Scene::Scene &scene,
               MPI_Comm            communicator,
               RunLog             &log,
               const Partition    &partition = {});

    /// Forces and accounts at the present positions.
    void
    evaluate();

    /// Everything moves on to the next time.
    void
    advance();

    double
    time() const
    {
      return clock.time();
    }

    double
    time_step() const
    {
      return clock.time_step();
    }

    unsigned long long
    step() const
    {
      return clock.step();
    }

    /// The largest that should do, whatever the scene says [s].
    double
    safe_time_step() const;

    /// As the forces of total Lagrangian bodies themselves say, see SPH::Solid,
    /// by rule for others [s]. Before the first evaluate().
    double
    measured_stable_step();

    /// The steps from now on [s]; before evaluate().
    void
    change_time_step(const double time_step)
    {
      clock.set_time_step(time_step);
    }

    /// What the guards look at; as long as this object lives.
    GuardedSystem
    guarded() const;

    /// Everything in joules at the last evaluate(); collective, as all sums
    /// over particles are.
    Measure::Energies
    energies() const;

    dealii::Tensor<1, 2>
    momentum() const;

    /// Sum over all that momentum() is of [kg m/s].
    double
    masses_times_speeds() const;

    /// Impulses of the conditions [N s].
    std::vector<dealii::Tensor<1, 2>>
    impulses() const;

    /// What a condition of the scene gives to its body now [N].
    Vector2
    force(unsigned int condition) const;

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

    /// Those that the ranks share.
    std::vector<const SPH::Solid *>
    shared_bodies() const;

  private:
    const Scene::Scene &scene;
    const MPI_Comm      communicator;
    RunLog             &log;

    std::vector<std::unique_ptr<SPH::DeformableBody>> solids;
    std::vector<SPH::AppliedConditions>               conditions;

    StepClock clock;
    double    automatic_step = 0.; ///< [s]
  };
} // namespace Morsel

#endif
