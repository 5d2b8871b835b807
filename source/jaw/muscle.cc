#include <morsel/jaw/muscle.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Jaw
{
  double
  MuscleFactors::force_length(const double length)
  {
    constexpr double width = 0.45;
    return std::exp(-(length - 1.) * (length - 1.) / width);
  }


  double
  MuscleFactors::passive(const double length)
  {
    constexpr double shape = 5., strain_at_full_force = 0.6;
    return length <= 1.
               ? 0.
               : (std::exp(shape * (length - 1.) / strain_at_full_force) - 1.) /
                     (std::exp(shape) - 1.);
  }


  namespace
  {
    constexpr double curvature = 0.25, on_stretching = 1.4;
  }


  double
  MuscleFactors::force_velocity(const double shortening)
  {
    if (shortening >= 0.)
      return std::max(0., (1. - shortening) / (1. + shortening / curvature));
    const double x = -shortening * (2. + 2. / curvature) / (on_stretching - 1.);
    return (1. + x * on_stretching) / (1. + x);
  }


  namespace
  {
    double
    distance_of(const MuscleParameters &parameters)
    {
      return parameters.origin.distance(parameters.insertion);
    }
  } // namespace


  Muscle::Muscle(const MuscleParameters &parameters,
                 const dealii::Point<2> &condyle)
      : parameters(parameters)
      , condyle(condyle)
      , activation(parameters.activation + "; 0")
      , optimal_path(parameters.optimal_path > 0. ? parameters.optimal_path
                                                  : distance_of(parameters))
  {}


  Muscle::State
  Muscle::at(const double time, const double angle, const double spin) const
  {
    Frame jaw;
    jaw.pivot              = condyle;
    jaw.angle              = angle;
    const auto   insertion = jaw.place(parameters.insertion);
    const auto   line      = parameters.origin - insertion;
    const double path      = line.norm();
    const double lever     = cross(insertion - condyle, line / path);
    const double length = 1. + (path - optimal_path) / parameters.fibre_length;
    const double active = std::clamp(activation(condyle, time)[0], 0., 1.);
    // The path gets shorter by the lever arm times the angle. A muscle that is
    // half awake is slow, too.
    const double fastest =
        (0.25 + 0.75 * active) * parameters.fastest * parameters.fibre_length;
    const double factor = active * MuscleFactors::force_length(length) *
                          MuscleFactors::force_velocity(lever * spin / fastest);
    const double force =
        parameters.maximal_force * (factor + MuscleFactors::passive(length));
    return {force, force * lever, length};
  }


  double
  Muscle::largest_damping() const
  {
    const double lever = parameters.insertion.distance(condyle);
    return 2. * (1. + 1. / curvature) * parameters.maximal_force * lever *
           lever / (parameters.fastest * parameters.fibre_length);
  }
} // namespace Morsel::Jaw
