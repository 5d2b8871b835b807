#ifndef morsel_calibrate_rounds_h
#define morsel_calibrate_rounds_h

#include <morsel/calibrate/problem.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Morsel::Calibrate
{
  /// One run of a round.
  struct Sample
  {
    unsigned int seed  = 0;
    double       value = 0.; ///< [Pa]
    std::string  folder;     ///< below the folder of results
    bool         kept = false;
    /// Whether the force fell to its residual share after the peak; true where
    /// the run does not say.
    bool complete_failure = true;
  };


  /// What one round found of a target.
  struct Measurement
  {
    std::vector<Sample>   samples;
    double                mean  = 0.;     ///< [Pa]
    double                error = 0.;     ///< (mean - target)/target [1]
    std::optional<double> deviation;      ///< of the samples over the mean [1]
    std::optional<double> standard_error; ///< of the mean over the mean [1]
  };


  /// The runs of all seeds and targets with the same parameters.
  struct Round
  {
    double                   threshold_factor = 0.;
    double                   strength_ratio   = 0.;
    std::vector<Measurement> targets; ///< as in Problem::targets

    /// The largest error of a target [1].
    double
    largest_error() const;
  };


  /// Mean, error and scatter of what the runs gave.
  /// @param samples not empty
  Measurement
  measurement_of(std::vector<Sample> samples, double target);


  /// Carries out the runs of a round side by side, each a process of its own,
  /// unless they have finished before.
  /// @param round its parameters; its targets are filled in
  /// @param folder of results; the runs' are below it
  /// @param threads of each run
  /// @param tell gets a line for each run that has come to its end
  /// @throw NumericalError if a run failed or nothing broke in it
  /// @throw InputError if the runs do not give the result asked for
  /// @throw Interrupted
  void
  carry_out(const Problem                                  &problem,
            unsigned int                                    number,
            Round                                          &round,
            const std::string                              &folder,
            unsigned int                                    threads,
            const std::function<void(const std::string &)> &tell);
} // namespace Morsel::Calibrate

#endif
