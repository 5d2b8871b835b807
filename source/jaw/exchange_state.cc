// What plates and their drives remember from step to step.

#include <morsel/core/state_archive.h>
#include <morsel/jaw/dynamic_deformation.h>
#include <morsel/jaw/plate.h>

namespace Morsel::Jaw
{
  void
  InertialDrive::exchange_state(StateArchive &state)
  {
    state.same(now, q, half_rate, whole_rate, lag, acceleration, action);
    state.same(reaction, accounted_at, drag, work_done, damped);
    state.sum(to_come);
  }


  void
  Plate::exchange_state(StateArchive &state)
  {
    state.same(now, placed, accounted_at, half_step_velocity);
    state.sum(load, push, push_moment, work_done);
    state.sum(impulse_given, impulse_to_come);
    if (deformation)
      deformation->exchange_state(state);
  }


  void
  DynamicDeformation::exchange_state(StateArchive &state)
  {
    state.same(R, w, half_velocity, acceleration, outer_loads);
    state.same(surface_velocity, last_drive, lag);
  }
} // namespace Morsel::Jaw
