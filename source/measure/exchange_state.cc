// What measures remember from step to step.

#include <morsel/core/state_archive.h>
#include <morsel/measure/breakage.h>
#include <morsel/measure/energy_ledger.h>
#include <morsel/measure/probe.h>
#include <morsel/measure/stroke.h>

namespace Morsel::Measure
{
  void
  EnergyLedger::exchange_state(StateArchive &state)
  {
    state.same(initial, largest, peak_force, error_peak, error_last);
    state.same(worst_gap, last_sample, peak_sample);
  }


  void
  MomentumLedger::exchange_state(StateArchive &state)
  {
    state.same(initial, largest, error_last, worst_gap);
  }


  void
  Stroke::exchange_state(StateArchive &state)
  {
    state.same(points, largest_normal, largest_tangential, force, peak);
    state.same(peak_time, peak_index, half_time, half_index);
    state.same(failure_time, failure_closure, failed);
  }


  void
  CrackGrowth::exchange_state(StateArchive &state)
  {
    state.particles(is_crack);
    state.same(course, fastest);
  }


  void
  Passages::exchange_state(StateArchive &state)
  {
    state.same(begun, last_time, last_value, count, first, last);
  }


  void
  Breakage::exchange_state(StateArchive &state)
  {
    const auto &p = solid.get_particles();
    state.name_particles(p.id, p.n_owned);
    state.particles(known);
    state.same(share, first);
    for (CrackGrowth &crack : growth)
      crack.exchange_state(state);
  }
} // namespace Morsel::Measure
