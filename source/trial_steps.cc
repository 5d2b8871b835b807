#include "trial_steps.h"

#include "costs.h"

#include <deal.II/base/utilities.h>

namespace Morsel
{
  void
  predict_steps(Prediction         &prediction,
                const Scene::Scene &scene,
                const double        n_particles,
                const Times        &step_time,
                const double        n_steps)
  {
    const Costs  costs;
    const double samples =
        std::min<double>(scene.output.history_samples, prediction.steps);
    const double frames =
        scene.output.fields
            ? std::min<double>(scene.output.field_frames, prediction.steps)
            : 0.;
    const double tasks = n_particles * (samples * costs.figure("sample") +
                                        frames * costs.figure("frame"));
    const Times  start = start_time();
    const Times  task  = measure(Workload::explicit_particles);
    prediction.seconds =
        start.wall + n_steps * step_time.wall + tasks * task.wall;
    prediction.processor_seconds = start.processor +
                                   n_steps * step_time.processor +
                                   tasks * task.processor;
    // The body stands already; frames and accounts come on top of it.
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    prediction.bytes =
        1024. * memory.VmHWM + n_particles * costs.figure("frame memory");
    prediction.basis = "steps tried now";
  }
} // namespace Morsel
