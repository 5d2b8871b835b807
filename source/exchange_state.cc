// What runs and their recorders remember from step to step.

#include "bite.h"
#include "experiment.h"
#include "experiment_recorder.h"
#include "recorder.h"

#include <morsel/core/state_archive.h>

#include <numeric>

namespace Morsel
{
  void
  Experiment::exchange_state(StateArchive &state)
  {
    state.same(clock);
    for (auto &solid : solids)
      solid->exchange_state(state);
    for (auto &of_body : conditions)
      of_body.exchange_state(state);
  }


  void
  Bite::exchange_state(StateArchive &state)
  {
    state.same(clock);
    if (state.loads())
      adapt_to_time_step();
    for (auto &solid : solids)
      solid->exchange_state(state);
    for (auto &of_body : conditions)
      of_body.exchange_state(state);
    for (auto &plate : plates)
      plate.exchange_state(state);
    for (const auto &drive : drives)
      drive->exchange_state(state);
    for (auto &pair : pairs)
      {
        const SPH::Particles &p = solids[pair.solid]->get_particles();
        state.name_particles(p.id, p.n_owned);
        pair.contact->exchange_state(state);
      }
    for (auto &meeting : meetings)
      {
        // The first rank alone brings them together.
        const bool first =
            dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
        std::vector<unsigned long long> nodes(first ? meeting.places.size()
                                                    : 0);
        std::iota(nodes.begin(), nodes.end(), 0ull);
        state.name_particles(nodes, nodes.size());
        meeting.contact->exchange_state(state);
      }
    for (auto &two : neighbours)
      two.contact->exchange_state(state);
  }


  void
  Cadence::exchange_state(StateArchive &state)
  {
    state.same(interval, next, spent, limit);
  }


  void
  DriveRecord::exchange_state(StateArchive &state)
  {
    state.same(moving, touched, peak_force);
  }


  void
  ToothCrackRecorder::exchange_state(StateArchive &state)
  {
    for (Body &body : bodies)
      {
        state.same(body.smallest_opening,
                   body.largest_opening,
                   body.force_at_smallest);
        for (Tip &tip : body.tips)
          state.same(tip.largest_I,
                     tip.largest_II,
                     tip.largest,
                     tip.smallest_I,
                     tip.largest_spread,
                     tip.growth);
      }
  }


  void
  Recorder::exchange_state(StateArchive &state)
  {
    stroke.exchange_state(state);
    energy.exchange_state(state);
    momentum.exchange_state(state);
    if (breakage)
      breakage->exchange_state(state);
    drives.exchange_state(state);
    history_due.exchange_state(state);
    frame_due.exchange_state(state);
    tooth_cracks.exchange_state(state);
    rank_load.exchange_state(state);
    state.same(pattern_at_half, deflections, last_sample_time);
    state.same(last_frame_time, deepest, most_inverted, last_kinetic);
    state.same(last_strain);

    std::size_t n_surfaces = surfaces_at_peak.size();
    state.same(n_surfaces);
    if (state.loads())
      {
        surfaces_at_peak.clear();
        for (std::size_t p = 0; p < n_surfaces; ++p)
          surfaces_at_peak.push_back(bite.get_plates()[p].surface);
      }
    for (auto &surface : surfaces_at_peak)
      {
        state.same(surface.nodes, surface.velocity);
        state.sum(surface.force);
      }
    // One rank alone keeps the history.
    std::string rows = history ? history->rows() : "";
    state.same(rows);
    if (history && state.loads())
      history->restore(rows);
    if (particle_frames)
      particle_frames->exchange_state(state);
    if (plate_frames)
      plate_frames->exchange_state(state);
    if (surface_frames)
      surface_frames->exchange_state(state);
    if (elastic_frames)
      elastic_frames->exchange_state(state);
  }


  void
  BreakingRecorder::exchange_state(StateArchive &state)
  {
    for (Followed &f : followed)
      f.breakage.exchange_state(state);
    for (Loading &load : loads)
      state.same(load.direction);
    if (stroke)
      stroke->exchange_state(state);
    state.same(displacement,
               displacement_at_peak,
               load_at_first_failure,
               last_strain,
               last_kinetic);
  }


  void
  ExperimentRecorder::exchange_state(StateArchive &state)
  {
    for (Observed &o : observed)
      o.passages.exchange_state(state);
    for (Gauged &g : gauged)
      {
        std::size_t n_tips = g.tips.size();
        state.same(n_tips);
        g.tips.resize(n_tips);
        for (Fracture::TipResult &tip : g.tips)
          {
            state.same(tip.tip, tip.rings, tip.by_ring, tip.energy_release);
            state.same(tip.energy_release_across, tip.statistics);
            state.same(tip.n_rings_on_blending_layer, tip.remark);
          }
      }
    breaking.exchange_state(state);
    energy.exchange_state(state);
    momentum.exchange_state(state);
    state.same(roughness, sample_times, next_sample, next_frame);
    state.same(last_sample_time, last_frame_time, least_spacing);
    rank_load.exchange_state(state);
    // One rank alone keeps the history.
    std::string rows = history ? history->rows() : "";
    state.same(rows);
    if (history && state.loads())
      history->restore(rows);
    for (auto &series : frames)
      series->exchange_state(state);
  }
} // namespace Morsel
