#ifndef morsel_run_summary_h
#define morsel_run_summary_h

#include <morsel/core/log.h>
#include <morsel/output/summary.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/static_solid.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// A name for columns and results: what is no letter or digit becomes '_'.
  std::string
  underscored(std::string name);


  /// How far a time loop went and what it took.
  struct LoopCosts
  {
    double             particle_count = 0.;
    unsigned long long step_count     = 0;
    double             time_step = 0., simulated_time = 0.; ///< [s]
    double             wall_time      = 0.; ///< of the whole run [s]
    double             loop_wall_time = 0.; ///< of the loop alone [s]
  };


  /// Counts, steps, wall times and particle-steps per second.
  void
  add_loop_costs(Output::Summary &summary, const LoopCosts &costs);


  /// Unknowns, iterations and how converged a static solution is.
  void
  add_static_report(Output::Summary &summary, const SPH::StaticReport &report);


  /// The effects of a run in time with what they took, and its parts.
  void
  add_effects(Output::Summary            &summary,
              std::vector<Output::Effect> effects,
              const RunLog               &log);


  /// Whether a body's grains differ, and in what.
  Output::Effect
  effect_of_grains(const Scene::ParticleBody &body);


  /// Title, versions, hash of the parameters, ranks, threads, peak memory;
  /// collective over all ranks.
  void
  add_provenance(Output::Summary   &summary,
                 const std::string &title,
                 const std::string &scene,
                 const std::string &parameters_hash,
                 const MPI_Comm     communicator);
} // namespace Morsel

#endif
