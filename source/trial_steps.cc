#include "trial_steps.h"

#include "costs.h"

#include <deal.II/base/utilities.h>

namespace Morsel
{
  void
  predict_steps(Prediction         &prediction,
                const Scene::Scene &scene,
                const double        n_particles,
                const double        step_time,
                const double        n_steps)
  {
    const Costs  costs;
    const double samples =
        std::min<double>(scene.output.history_samples, prediction.steps);
    const double frames =
        scene.output.fields
            ? std::min<double>(scene.output.field_frames, prediction.steps)
            : 0.;
    prediction.seconds =
        start_time() + step_time * (n_steps + samples * costs.figure("sample") +
                                    frames * costs.figure("frame"));
    // The body stands already; frames and accounts come on top of it.
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    prediction.bytes =
        1024. * memory.VmHWM + n_particles * costs.figure("frame memory");
    prediction.basis = "steps tried now";
  }
} // namespace Morsel
