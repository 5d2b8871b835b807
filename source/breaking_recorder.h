#ifndef morsel_source_breaking_recorder_h
#define morsel_source_breaking_recorder_h

#include "experiment.h"

#include <morsel/core/expression.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/measure/breakage.h>
#include <morsel/measure/stroke.h>
#include <morsel/output/summary.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Morsel
{
  /// Follows how the bodies of an experiment break, and under which load. The
  /// load is the mean force of the conditions that move a side or a box, along
  /// their motion; without any, of those that load one.
  class BreakingRecorder
  {
  public:
    BreakingRecorder(const Scene::Scene &scene, const Experiment &experiment);

    /// Whether any body can fail; without, there is nothing to record.
    bool
    active() const
    {
      return !followed.empty();
    }

    /// Whether something of body @p body has failed.
    bool
    has_failed(unsigned int body) const;

    /// The piece of each particle of body @p body now, -1 where it has failed.
    std::vector<int>
    labels(unsigned int body) const;

    /// Takes the present state in, at every step.
    void
    follow();

    /// Takes the energies of a sample in.
    void
    note(const Measure::Energies &e);

    /// Whether the load has fallen for good after its peak, as the scene's
    /// rule says; never under a prescribed load.
    bool
    broken() const;

    /// Columns of the history, and their values now.
    std::vector<std::string>
    columns() const;

    std::vector<double>
    row() const;

    void
    exchange_state(StateArchive &state);

    /// Names of results without a body's name where only one can fail.
    void
    summarise(Output::Summary &summary) const;

  private:
    struct Followed
    {
      unsigned int             body;
      const SPH::Solid        *solid;
      std::string              suffix;
      Measure::Breakage        breakage;
      std::vector<std::string> tips; ///< suffixes of its cracks' tips
    };

    /// A condition that makes the load.
    struct Loading
    {
      unsigned int         condition;
      VectorExpression     value;
      bool                 moves;
      dealii::Tensor<1, 2> direction; ///< of its motion or load, last known
    };

    void
    find_loads();

    Measure::StrokeSettings
    stroke_settings() const;

    void
    summarise_load(Output::Summary &summary) const;

    void
    summarise_body(Output::Summary &summary, const Followed &f) const;

    const Scene::Scene &scene;
    const Experiment   &experiment;

    std::vector<Followed>            followed;
    std::vector<Loading>             loads;
    std::unique_ptr<Measure::Stroke> stroke;

    double displacement         = 0.; ///< of all that move, together [m]
    double displacement_at_peak = 0., load_at_first_failure = 0.;
    double last_strain = 0., last_kinetic = 0.;
  };


  /// The places of the tips of a body's cracks [m].
  std::vector<dealii::Point<2>>
  tip_places(const Scene::ParticleBody &body);


  /// When and where a body first failed.
  void
  add_first_failure(Output::Summary         &summary,
                    const Measure::Breakage &breakage,
                    const std::string       &suffix);


  /// How the cracks of a body grew.
  void
  add_crack_growth(Output::Summary                &summary,
                   const SPH::Solid               &solid,
                   const Measure::Breakage        &breakage,
                   const std::vector<std::string> &suffixes);
} // namespace Morsel

#endif
