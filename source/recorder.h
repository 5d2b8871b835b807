#ifndef morsel_source_recorder_h
#define morsel_source_recorder_h

#include "bite.h"
#include "drive_record.h"
#include "loop_report.h"
#include "rank_load.h"
#include "recorder_cracks.h"

#include <morsel/contact/traction.h>
#include <morsel/core/run_options.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/measure/breakage.h>
#include <morsel/measure/energy_ledger.h>
#include <morsel/measure/fracture_pattern.h>
#include <morsel/measure/fragments.h>
#include <morsel/measure/stroke.h>
#include <morsel/output/frames.h>
#include <morsel/output/history.h>
#include <morsel/output/summary.h>

#include <memory>
#include <string>

namespace Morsel
{
  /// When something of a limited number is due, if nobody knows how long the
  /// run will be: at a fixed interval until half of the budget is spent, then
  /// at twice that until half of the rest is, and so on.
  class Cadence
  {
  public:
    Cadence(unsigned int budget, double interval);

    bool
    is_due(const double time) const
    {
      return !(time < next * (1. - 1e-12));
    }

    /// Whether something is due at @p time; it then counts as done.
    bool
    due(double time);

    void
    exchange_state(StateArchive &state);

  private:
    double budget, interval, next = 0., spent = 0., limit;
  };


  /// Why a run ended.
  enum class StopReason
  {
    none,
    complete_failure,
    maximum_closure,
    end_time
  };


  /// Follows a run: measures, history, fields, and the summary at its end.
  class Recorder
  {
  public:
    /// Opens the outputs. @throws FileError.
    Recorder(const Scene::Scene &scene,
             const RunOptions   &options,
             const Bite         &bite,
             RunLog             &log,
             MPI_Comm            communicator);

    /// Whether follow() is going to take the energies in.
    bool
    samples_now() const;

    /// Whether it is going to write something.
    bool
    records_now() const;

    /// Takes the present state in: forces at every step, energies, history
    /// and fields when they are due.
    void
    follow();

    const Measure::EnergyLedger &
    energy_ledger() const
    {
      return energy;
    }

    StopReason
    stop_reason() const;

    bool
    finished() const
    {
      return stop_reason() != StopReason::none;
    }

    /// Share of the run that is done, as far as one can know [1].
    double
    progress() const;

    /// Saves or loads what has been recorded; the files of the results are
    /// brought back to it.
    void
    exchange_state(StateArchive &state);

    /// The last sample, fragments, and summary.json.
    void
    finish(const LoopReport &report);

  private:
    void
    sample();

    void
    write_frame();

    /// Of those that deform.
    void
    write_elastic_plates();

    void
    follow_deflections();

    /// What the plates' surfaces feel.
    void
    write_surfaces();

    /// Keeps the surfaces with their forces if the force is at its peak.
    void
    follow_surfaces();

    void
    write_surface_table(const std::vector<Contact::Traction> &tractions) const;

    void
    summarise_surfaces();

    /// Area of new surface and what it took.
    void
    summarise_new_surface();

    void
    write_fragments();

    void
    find_fragments();

    std::optional<Measure::FracturePattern>
    find_pattern() const;

    void
    summarise_stroke(StopReason reason);

    /// What scaled mass made of the kinetic energy; nothing without.
    void
    summarise_mass_scaling();

    /// How the food broke: the fall behind the peak and the pattern of damage.
    void
    summarise_break();

    void
    summarise_pattern(const std::optional<Measure::FracturePattern> &pattern,
                      const std::string                             &suffix,
                      const std::string                             &moment);

    void
    summarise_fragments();

    void
    summarise_fragment_sizes();

    void
    summarise_plates();

    void
    summarise_ledgers();

    void
    summarise_run();

    void
    summarise_effects();

    const Scene::Scene &scene;
    const RunOptions   &options;
    const Bite         &bite;
    RunLog             &log;
    const MPI_Comm      communicator;
    const bool          first_rank;

    Measure::Stroke                    stroke;
    Measure::EnergyLedger              energy;
    Measure::MomentumLedger            momentum;
    std::unique_ptr<Measure::Breakage> breakage;
    DriveRecord                        drives;
    Measure::Fragments                 fragments;
    Measure::Fragments                 intact;

    /// When the force had fallen to half of its peak.
    std::optional<Measure::FracturePattern> pattern_at_half;

    Cadence                            history_due, frame_due;
    std::unique_ptr<Output::History>   history;
    std::unique_ptr<Output::Frames<0>> particle_frames;
    std::unique_ptr<Output::Frames<2>> plate_frames;
    std::unique_ptr<Output::Frames<2>> elastic_frames;
    std::unique_ptr<Output::Frames<1>> surface_frames;
    Output::Summary                    summary;

    std::vector<double> deflections; ///< largest so far, by plate [m]
    /// As they were at the peak of the mean force, this rank's forces.
    std::vector<Contact::Surface> surfaces_at_peak;
    ToothCrackRecorder            tooth_cracks;
    RankLoad                      rank_load;

    double       last_sample_time = -1.;
    double       last_frame_time  = -1.;
    double       deepest          = 0.;
    unsigned int most_inverted    = 0;
    double       last_kinetic     = 0.;
    double       last_strain      = 0.;
  };


  /// The effects of a scene: on or off, and who asked for each.
  std::vector<Output::Effect>
  effects_of(const Scene::Scene &scene);


  /// Closure at which the food is expected to fail [m], from strength over
  /// plane-strain modulus; the whole run's closure where it cannot fail.
  double
  expected_failure_closure(const Scene::Scene &scene, unsigned int axis);
} // namespace Morsel

#endif
