#ifndef morsel_source_costs_h
#define morsel_source_costs_h

#include <morsel/calibration.h>
#include <morsel/prediction.h>

#include <map>
#include <string>

namespace Morsel
{
  /// Sizes that a cost depends on, by name: "cells", "unknowns", ...
  using Sizes = std::map<std::string, double>;


  /// What parts of runs cost, from data/recorded/costs.json: sums of products
  /// of powers of sizes, in the processor time of the machine that recorded
  /// them.
  class Costs
  {
  public:
    /// @throws FileError
    Costs();

    /// @param part "finite elements solution" and the like
    /// @param what "seconds" or "bytes"
    double
    of(const std::string &part,
       const std::string &what,
       const Sizes       &sizes) const;

    /// A figure that stands for itself.
    double
    figure(const std::string &name) const;

    /// Sets the times of a prediction: the program's start, and recorded
    /// seconds times how much longer this machine takes now, with the threads
    /// in use, than the one that recorded: by a calibration of a third of a
    /// second, made once.
    void
    predict_time(Prediction &prediction,
                 Workload    workload,
                 double      seconds) const;

  private:
    nlohmann::ordered_json document;
  };
} // namespace Morsel

#endif
