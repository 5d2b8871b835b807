#ifndef morsel_calibration_h
#define morsel_calibration_h

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace Morsel
{
  /// Tasks of fixed size whose times tell machines apart.
  enum class Workload
  {
    finite_elements,   ///< an XFEM plate: assembly and factorisation
    static_particles,  ///< a particle plate: gradient and conjugate gradients
    explicit_particles ///< steps of a particle body
  };

  const std::vector<Workload> &
  all_workloads();

  /// "finite elements", ...
  std::string
  name_of(Workload workload);


  /// Two measures of time [s].
  struct Times
  {
    double wall      = 0.; ///< with the threads in use
    double processor = 0.; ///< of all threads
  };

  /// What a call takes.
  Times
  time_of(const std::function<void()> &task);

  /// What the task takes: the mean over as many repetitions as fit into a
  /// third of a second after a first one that does not count, since what
  /// follows will meet the same load of the machine.
  Times
  measure(Workload workload);


  /// From the start of this process to the first call [s]: the main program
  /// calls it before it does anything.
  Times
  start_time();

  /// Of all threads of this process so far [s].
  double
  processor_time();


  /// All workloads, about a second: {"threads", "workloads": {name:
  /// {"wall_time", "processor_time"}}, "start_time"} [s], what studies that
  /// measure time leave beside their results. Call it on one rank.
  nlohmann::ordered_json
  calibration_json();
} // namespace Morsel

#endif
