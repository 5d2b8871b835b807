#ifndef morsel_source_trial_steps_h
#define morsel_source_trial_steps_h

#include <morsel/calibration.h>
#include <morsel/prediction.h>
#include <morsel/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>

namespace Morsel
{
  /// Mean times of a step [s] of a system that has not begun, from steps
  /// that are thrown away: some that warm up, then as many as fit into two
  /// thirds of a second, but no more than the run has. Ranks agree on their
  /// number, since steps are collective.
  template <typename System>
  Times
  trial_step_time(System &system, double steps_of_run);


  /// Time and memory of a run of steps: for each particle, its samples and
  /// frames cost recorded numbers of Workload::explicit_particles; the
  /// program's start is added.
  /// @param step_time of trial steps [s]
  /// @param n_steps that cost as much as all of the run's
  void
  predict_steps(Prediction         &prediction,
                const Scene::Scene &scene,
                double              n_particles,
                const Times        &step_time,
                double              n_steps);


  template <typename System>
  Times
  trial_step_time(System &system, const double steps_of_run)
  {
    using Clock        = std::chrono::steady_clock;
    const auto advance = [&system](const unsigned int n) {
      for (unsigned int k = 0; k < n; ++k)
        {
          system.advance();
          system.evaluate();
        }
    };
    const auto time_of = [&advance](const unsigned int n) {
      const auto   begin     = Clock::now();
      const double processor = processor_time();
      advance(n);
      return Times{
          dealii::Utilities::MPI::max(
              std::chrono::duration<double>(Clock::now() - begin).count(),
              MPI_COMM_WORLD),
          processor_time() - processor};
    };
    system.evaluate();
    constexpr double duration = 2. / 3.; // [s]
    const double     warm_up  = std::min(10., steps_of_run);
    const Times      first    = time_of(warm_up);
    if (steps_of_run <= 2. * warm_up)
      return {first.wall / std::max(1., warm_up),
              first.processor / std::max(1., warm_up)};
    // In portions, since the first step's time is no measure of the next.
    Times  sum;
    double n = 0.;
    while (sum.wall < duration && n < steps_of_run)
      {
        const Times portion = time_of(10);
        sum.wall += portion.wall;
        sum.processor += portion.processor;
        n += 10.;
      }
    return {sum.wall / n, sum.processor / n};
  }
} // namespace Morsel

#endif
