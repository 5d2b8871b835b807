#include <morsel/measure/stroke.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace Morsel::Measure
{
  Stroke::Stroke(const StrokeSettings &settings)
      : settings(settings)
  {
    AssertThrow(settings.loaded_area > 0. && settings.height > 0.,
                dealii::ExcMessage("A stroke needs food of some size."));
  }


  void
  Stroke::add(const StrokeSample &sample)
  {
    const auto &normal     = sample.normal_force;
    const auto &tangential = sample.tangential_force;
    largest_normal.resize(normal.size(), 0.);
    largest_tangential.resize(tangential.size(), 0.);
    for (std::size_t p = 0; p < normal.size(); ++p)
      largest_normal[p] = std::max(largest_normal[p], normal[p]);
    for (std::size_t p = 0; p < tangential.size(); ++p)
      largest_tangential[p] = std::max(largest_tangential[p], tangential[p]);

    force = normal.empty() ? 0.
                           : std::accumulate(normal.begin(), normal.end(), 0.) /
                                 static_cast<double>(normal.size());
    points.push_back({sample.closure / settings.height,
                      force / settings.loaded_area,
                      sample.kinetic_energy,
                      sample.strain_energy});
    follow_failure(sample);
  }


  void
  Stroke::follow_failure(const StrokeSample &sample)
  {
    if (force > peak)
      {
        peak       = force;
        peak_time  = sample.time;
        peak_index = points.size() - 1;
        // What fell before a higher peak was no failure.
        half_time.reset();
        if (!failed)
          failure_time.reset();
        return;
      }
    const bool counts =
        peak > 0. && peak / settings.loaded_area >= settings.minimum_peak;
    if (counts && !half_time && force < 0.5 * peak)
      {
        half_time  = sample.time;
        half_index = points.size() - 1;
      }
    if (counts && !failure_time && force < settings.residual_force * peak)
      {
        failure_time    = sample.time;
        failure_closure = sample.closure;
      }
    if (failure_time && sample.closure - failure_closure >=
                            settings.closure_after_failure * settings.height)
      failed = true;
  }


  double
  Stroke::mean_force() const
  {
    return force;
  }


  double
  Stroke::nominal_stress() const
  {
    return force / settings.loaded_area;
  }


  double
  Stroke::nominal_strain() const
  {
    return points.empty() ? 0. : points.back().strain;
  }


  double
  Stroke::peak_force(const unsigned int plate) const
  {
    return plate < largest_normal.size() ? largest_normal[plate] : 0.;
  }


  double
  Stroke::peak_tangential_force(const unsigned int plate) const
  {
    return plate < largest_tangential.size() ? largest_tangential[plate] : 0.;
  }


  double
  Stroke::peak_mean_force() const
  {
    return peak;
  }


  double
  Stroke::time_of_peak() const
  {
    return peak_time;
  }


  double
  Stroke::strain_at_peak() const
  {
    return points.empty() ? 0. : points[peak_index].strain;
  }


  double
  Stroke::compressive_strength() const
  {
    return peak / settings.loaded_area;
  }


  std::optional<double>
  Stroke::compressive_strength_error() const
  {
    if (!settings.prescribed_strength || *settings.prescribed_strength == 0.)
      return std::nullopt;
    return compressive_strength() / *settings.prescribed_strength - 1.;
  }


  std::optional<double>
  Stroke::stiffness() const
  {
    const double strength = compressive_strength();
    double       n = 0., x = 0., y = 0., xx = 0., xy = 0.;
    for (std::size_t i = 0; i < points.size() && i <= peak_index; ++i)
      if (const auto &p = points[i];
          p.stress >= 0.2 * strength && p.stress <= 0.6 * strength)
        {
          n += 1.;
          x += p.strain;
          y += p.stress;
          xx += p.strain * p.strain;
          xy += p.strain * p.stress;
        }
    const double spread = n * xx - x * x;
    if (n < 3. || !(spread > 0.))
      return std::nullopt;
    return (n * xy - x * y) / spread;
  }


  std::optional<double>
  Stroke::kinetic_over_strain_energy() const
  {
    const auto before =
        std::find_if(points.begin(), points.end(), [this](const Point &p) {
          return p.stress >= 0.95 * compressive_strength();
        });
    if (!(peak > 0.) || before == points.end() || !(before->elastic > 0.))
      return std::nullopt;
    return before->kinetic / before->elastic;
  }


  std::optional<double>
  Stroke::largest_kinetic_over_strain_energy() const
  {
    if (!kinetic_over_strain_energy())
      return std::nullopt;
    double largest = 0.;
    for (const Point &p : points)
      {
        if (p.stress >= 0.5 * compressive_strength() && p.elastic > 0.)
          largest = std::max(largest, p.kinetic / p.elastic);
        if (p.stress >= 0.95 * compressive_strength())
          break;
      }
    return largest;
  }


  bool
  Stroke::failed_completely() const
  {
    return failed;
  }


  std::optional<double>
  Stroke::time_of_failure() const
  {
    return failure_time;
  }


  std::optional<double>
  Stroke::time_of_half_force() const
  {
    return half_time;
  }


  std::optional<double>
  Stroke::strain_from_peak_to_half() const
  {
    if (!half_time)
      return std::nullopt;
    return points[half_index].strain - strain_at_peak();
  }


  std::optional<double>
  Stroke::brittleness() const
  {
    if (!half_time || !(points[half_index].strain > 0.))
      return std::nullopt;
    return strain_at_peak() / points[half_index].strain;
  }


  std::optional<double>
  Stroke::residual_strength() const
  {
    if (!half_time)
      return std::nullopt;
    const double begin =
        0.5 * (points[half_index].strain + points.back().strain);
    double work = 0., strain = 0.;
    for (std::size_t i = half_index + 1; i < points.size(); ++i)
      if (points[i - 1].strain >= begin)
        {
          const double step = points[i].strain - points[i - 1].strain;
          strain += step;
          work += 0.5 * step * (points[i].stress + points[i - 1].stress);
        }
    if (!(strain > 0.))
      return std::nullopt;
    return work / strain;
  }
} // namespace Morsel::Measure
