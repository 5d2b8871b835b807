#ifndef morsel_source_experiment_recorder_h
#define morsel_source_experiment_recorder_h

#include "breaking_recorder.h"
#include "experiment.h"
#include "loop_report.h"
#include "rank_load.h"

#include <morsel/core/run_options.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/measure/crack_gauge.h>
#include <morsel/measure/probe.h>
#include <morsel/output/frames.h>
#include <morsel/output/history.h>
#include <morsel/output/summary.h>

#include <memory>
#include <string>
#include <vector>

namespace Morsel
{
  /// Follows the run of a scene without plates: observed points, loads,
  /// ledgers, fields, and the summary at its end.
  class ExperimentRecorder
  {
  public:
    /// Opens the outputs. @throws FileError.
    ExperimentRecorder(const Scene::Scene &scene,
                       const RunOptions   &options,
                       const Experiment   &experiment,
                       RunLog             &log,
                       MPI_Comm            communicator);

    /// Whether follow() is going to take the energies in.
    bool
    samples_now() const;

    /// Whether it is going to write something.
    bool
    records_now() const;

    /// Takes the present state in, after evaluate().
    void
    follow();

    const Measure::EnergyLedger &
    energy_ledger() const
    {
      return energy;
    }

    /// Share of the run that is done [1].
    double
    progress() const;

    /// Whether the scene's rule ends the run.
    bool
    finished() const;

    /// Saves or loads what has been recorded; the files of the results are
    /// brought back to it.
    void
    exchange_state(StateArchive &state);

    /// The last sample and summary.json.
    void
    finish(const LoopReport &report);

  private:
    /// The tips of a body's cracks.
    struct Gauged
    {
      unsigned int                         body;
      std::unique_ptr<Measure::CrackGauge> gauge;
      std::vector<std::string>             suffixes;
      /// As of the last sample.
      std::vector<Fracture::TipResult> tips;
    };

    struct Observed
    {
      unsigned int      body;
      Measure::Probe    probe;
      Measure::Passages passages;
    };

    void
    open_gauges();

    void
    sample();

    void
    write_frame();

    void
    summarise_velocity_gradients();

    void
    summarise_observers();

    void
    summarise_cracks();

    void
    summarise_bodies();

    void
    summarise_roughness(unsigned int body, const std::string &name);

    void
    summarise_ledgers();

    void
    summarise_run();

    const Scene::Scene &scene;
    const RunOptions   &options;
    const Experiment   &experiment;
    RunLog             &log;
    const MPI_Comm      communicator;

    std::vector<Observed> observed;
    std::vector<Gauged>   gauged;
    BreakingRecorder      breaking;
    /// Roughness of velocity by sample and body [m/s], and the samples' times.
    std::vector<std::vector<double>> roughness;
    std::vector<double>              sample_times;
    Measure::EnergyLedger            energy;
    Measure::MomentumLedger          momentum;

    RankLoad                         rank_load;
    std::unique_ptr<Output::History> history; ///< on the first rank
    std::vector<std::unique_ptr<Output::Frames<0>>> frames;
    Output::Summary                                 summary;

    bool
    frame_is_due() const;

    double next_sample = 0., next_frame = 0.;
    double last_sample_time = -1., last_frame_time = -1.;
    double least_spacing = 2.;
  };


  /// Displacement [m] and stress [Pa] at an observed point, with what is
  /// expected of them.
  void
  add_observation(Output::Summary                    &summary,
                  const Scene::Observer              &observer,
                  const Vector2                      &displacement,
                  const Materials::PlaneStrainStress &stress);


  /// The effects of a scene without plates.
  std::vector<Output::Effect>
  effects_of_experiment(const Scene::Scene &scene);
} // namespace Morsel

#endif
