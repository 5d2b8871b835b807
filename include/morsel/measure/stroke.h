#ifndef morsel_measure_stroke_h
#define morsel_measure_stroke_h

#include <morsel/core/state_archive_fwd.h>

#include <optional>
#include <vector>

namespace Morsel::Measure
{
  /// What the analysis of a stroke needs to know beforehand.
  struct StrokeSettings
  {
    double loaded_area = 1.; ///< initial: width times depth [m^2]
    double height      = 1.; ///< of the food, initial [m]

    /// Complete failure: the mean force has fallen below this share of its
    /// peak [1] ...
    double residual_force = 0.2;
    /// ... and the plates have closed this much further since it fell below,
    /// relative to the height [1].
    double closure_after_failure = 0.01;
    /// Peaks of nominal stress below this are taken for the noise of the first
    /// touch, not for strength [Pa].
    double minimum_peak = 0.;

    std::optional<double> prescribed_strength; ///< [Pa]
  };


  /// One moment of a stroke.
  struct StrokeSample
  {
    double              time    = 0.;        ///< [s]
    double              closure = 0.;        ///< of the plates since touch [m]
    std::vector<double> normal_force;        ///< per plate, compression > 0 [N]
    std::vector<double> tangential_force;    ///< per plate, magnitude [N]
    double              strain_energy  = 0.; ///< [J]
    double              kinetic_energy = 0.; ///< [J]
  };


  /// Follows the force between the plates through a stroke.
  ///
  /// The nominal stress is the mean of the plates' normal forces over the
  /// initial loaded area, the nominal strain the closure over the initial
  /// height; both are positive in compression. The peak is that of the mean
  /// force, but for the largest forces of single plates.
  class Stroke
  {
  public:
    explicit Stroke(const StrokeSettings &settings);

    /// Appends a sample; times do not decrease, and the number of plates
    /// stays the same. Works in constant time.
    void
    add(const StrokeSample &sample);

    /// @name Now
    /// @{
    double
    mean_force() const;
    double
    nominal_stress() const;
    double
    nominal_strain() const;
    /// @}

    /// Largest normal force on one plate over time [N]. 0 without samples.
    double
    peak_force(unsigned int plate) const;

    /// Largest tangential force on one plate over time [N].
    double
    peak_tangential_force(unsigned int plate) const;

    /// Largest mean normal force over time [N].
    double
    peak_mean_force() const;

    double
    time_of_peak() const;

    double
    strain_at_peak() const;

    /// The largest nominal stress [Pa].
    double
    compressive_strength() const;

    /// (strength - prescribed) / prescribed, if one is prescribed.
    std::optional<double>
    compressive_strength_error() const;

    /// Slope of the nominal stress over the nominal strain between 20 % and
    /// 60 % of the peak on the way to it, by least squares [Pa]; nothing with
    /// fewer than three samples there.
    std::optional<double>
    stiffness() const;

    /// Kinetic over strain energy when 95 % of the peak was reached for the
    /// first time, which is before the break releases any [1]: small if the
    /// loading was quasi-static. Nothing without a peak or strain energy.
    std::optional<double>
    kinetic_over_strain_energy() const;

    /// The largest of that ratio from half of the peak on until there [1].
    std::optional<double>
    largest_kinetic_over_strain_energy() const;

    /// Whether the criterion of complete failure is met.
    bool
    failed_completely() const;

    /// When the force fell below its residual share [s]; nothing if it has
    /// not (since the last peak).
    std::optional<double>
    time_of_failure() const;

    /// When the force fell below half of its peak [s]; nothing if it has not
    /// (since the last peak).
    std::optional<double>
    time_of_half_force() const;

    /// Nominal strain from the peak to there [1].
    std::optional<double>
    strain_from_peak_to_half() const;

    /// Strain at the peak over that at half of the force behind it [1]: 1 if
    /// the force falls at once, 0.5 if falling takes as long as rising.
    std::optional<double>
    brittleness() const;

    /// Mean of the nominal stress over the strain of the last part of the
    /// stroke [Pa]: the second half of what follows the fall to half of the
    /// peak.
    std::optional<double>
    residual_strength() const;

    void
    exchange_state(StateArchive &state);

  private:
    /// What the analysis after the fact needs of a sample.
    struct Point
    {
      double strain, stress, kinetic, elastic;
    };

    void
    follow_failure(const StrokeSample &sample);

    StrokeSettings      settings;
    std::vector<Point>  points;
    std::vector<double> largest_normal;
    std::vector<double> largest_tangential;
    double              force = 0., peak = 0., peak_time = 0.;
    std::size_t         peak_index = 0;

    std::optional<double> half_time;
    std::size_t           half_index = 0;

    std::optional<double> failure_time;
    double                failure_closure = 0.;
    bool                  failed          = false;
  };
} // namespace Morsel::Measure

#endif
