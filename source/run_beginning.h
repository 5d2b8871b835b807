#ifndef morsel_source_run_beginning_h
#define morsel_source_run_beginning_h

#include "checkpoints.h"

#include <morsel/core/log.h>
#include <morsel/core/run_options.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/scene.h>

#include <cmath>
#include <sstream>
#include <string>

namespace Morsel
{
  /// Prepares the folder of results of a run in time: its log, the parameters,
  /// what an earlier run left there. Once everything about the scene that can
  /// be refused has been, since a refusal leaves nothing behind. Collective.
  /// @param log without a file
  void
  begin_results(const Scene::Scene &scene,
                const RunOptions   &options,
                Checkpoints        &checkpoints,
                RunLog             &log);

  /// By how much particles are heavier than their material, for the log; empty
  /// where they are not.
  std::string
  scaled_mass_text(const Scene::Scene &scene);

  /// What a run's step [s] is of the largest stable one that is measured before
  /// the first step, for the log: as ", 0.89 of the largest stable one
  /// (measured)". Nothing of a run that is too short for the measuring to be
  /// free. Warns of a step beyond it. Collective.
  template <typename System>
  std::string
  share_of_measured_step(System &system, const double end_time, RunLog &log)
  {
    // As much as some 20 steps.
    constexpr double shortest_run = 5000.;
    const double     step         = system.time_step();
    if (end_time < shortest_run * step)
      return "";
    const double       share = step / system.measured_stable_step();
    std::ostringstream text;
    text << ", " << std::round(100. * share) / 100.
         << " of the largest stable one (measured)";
    if (share > 1.)
      log.warning("The time step of " + number_text(step) + " s is " +
                  number_text(std::round(100. * share) / 100.) +
                  " of the largest stable one, as the forces between particles "
                  "themselves say.");
    return text.str();
  }
} // namespace Morsel

#endif
