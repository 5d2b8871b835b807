#ifndef morsel_plan_setting_h
#define morsel_plan_setting_h

#include <morsel/plan/record.h>
#include <morsel/study/formula.h>

#include <optional>

namespace Morsel::Plan
{
  /// The accuracy of the command line: "1e-3" or "0.1 %".
  /// @return relative error [1]
  /// @throws InputError unless it is a number above 0 and below 1
  double
  read_accuracy(const std::string &text);


  /// Between two recorded sizes errors go up and down, with where a crack
  /// runs through its cells: what is interpolated has to be better than
  /// wanted by this factor [1].
  constexpr double interpolation_margin = 1.5;


  /// The smallest recorded size from which on all runs have at most this
  /// error, since one lucky run does not count (Study::cost_to_reach); or a
  /// smaller one that has it, with the margin, between two runs interpolated
  /// in the logarithms.
  /// @return nothing if the largest size does not reach it
  std::optional<double>
  size_to_reach(const Method &method, double accuracy);


  /// The run of the largest size, which is the best that is known to hold.
  /// @pre there are runs
  const RecordedRun &
  largest_run(const Method &method);


  /// The entries that the method sets in a scene, "Section/Key=value".
  /// @param size of the method
  /// @param scene what else formulas may name, in SI units
  /// @param bodies names that stand for "{body}" in entries, each with
  ///   variables of its own; empty for scenes without bodies
  /// @throws FileError for a formula that is not understood
  std::vector<std::string>
  overrides_of(
      const Method                                                &method,
      double                                                       size,
      const Study::Variables                                      &scene,
      const std::vector<std::pair<std::string, Study::Variables>> &bodies);
} // namespace Morsel::Plan

#endif
