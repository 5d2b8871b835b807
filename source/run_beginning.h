#ifndef morsel_source_run_beginning_h
#define morsel_source_run_beginning_h

#include "checkpoints.h"

#include <morsel/core/log.h>
#include <morsel/core/run_options.h>
#include <morsel/scene/scene.h>

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
} // namespace Morsel

#endif
