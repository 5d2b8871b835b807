#include <morsel/calibrate/rounds.h>
#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/analysis.h>
#include <morsel/study/runner.h>

#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Calibrate
{
  namespace
  {
    /// The runs as a study of one series for each target, for its runner.
    Study::Study
    study_of(const Problem &problem, const unsigned int threads)
    {
      Study::Study study;
      for (const Target &target : problem.targets)
        {
          Study::Series &series = study.series.emplace_back();
          series.name           = target.name;
          series.base_scene     = target.scene;
        }
      study.threads      = threads;
      study.side_by_side = problem.parameters.side_by_side;
      if (study.side_by_side == 0)
        study.side_by_side =
            std::max(1u, dealii::MultithreadInfo::n_cores() / threads);
      study.time_limit = problem.parameters.time_limit;
      return study;
    }


    std::vector<Study::PlannedRun>
    runs_of(const Problem     &problem,
            const unsigned int number,
            const Round       &round)
    {
      std::vector<Study::PlannedRun> runs;
      for (unsigned int t = 0; t < problem.targets.size(); ++t)
        for (unsigned int k = 0; k < problem.parameters.seeds; ++k)
          {
            const Target      &target = problem.targets[t];
            const std::string  seed   = std::to_string(problem.first_seed + k);
            const std::string  damage = "Body " + target.body + "/Damage/";
            Study::PlannedRun &run    = runs.emplace_back();
            run.series                = t;
            run.overrides             = target.overrides;
            for (const std::string &entry :
                 {damage + "Threshold factor=" +
                      Study::value_text(round.threshold_factor),
                  damage + "Strength ratio=" +
                      Study::value_text(round.strength_ratio),
                  "Seed=" + seed,
                  std::string("Output/Fields=false")})
              run.overrides.push_back(entry);
            run.folder = target.name.substr(0, target.name.find(' ')) +
                         "_round=" + std::to_string(number) + "_seed=" + seed;
            run.label = target.name + ", round " + std::to_string(number) +
                        ", seed " + seed;
          }
      return runs;
    }


    std::vector<std::string>
    parameters_of(const Problem                        &problem,
                  const std::vector<Study::PlannedRun> &runs)
    {
      std::vector<std::string> parameters;
      for (const Study::PlannedRun &run : runs)
        parameters.push_back(Study::scene_parameters(
            problem.targets[run.series].scene, run.overrides));
      return parameters;
    }


    std::optional<double>
    result_named(const Study::Record &record, const char *name)
    {
      const auto result = record.results.find(name);
      return result == record.results.end()
                 ? std::nullopt
                 : std::optional<double>(result->second.value);
    }


    double
    value_of(const Target &target, const Study::Record &record)
    {
      Study::Variables         variables;
      std::vector<std::string> known;
      for (const auto &[name, result] : record.results)
        {
          variables[name] = result.value;
          known.push_back(name);
        }
      for (const std::string &name : Study::names_in(target.result))
        if (variables.count(name) == 0)
          throw InputError("--calibrate: the " + target.name + " shall be '" +
                           target.result + "', but '" + target.scene +
                           "' gives no result '" + name + "'." +
                           did_you_mean(name, known) +
                           " The names are those of its summary.json.");
      return Study::evaluate(target.result, variables);
    }


    Sample
    sample_of(const Target            &target,
              const Study::PlannedRun &run,
              const unsigned int       seed,
              const Study::Record     &record)
    {
      const std::string begin = "The run '" + run.label + "' of '" +
                                target.scene + "' (runs/" + run.folder + ") ";
      if (record.state == Study::Record::State::failed)
        throw NumericalError(begin + "failed: " + record.message);
      Sample sample;
      sample.seed             = seed;
      sample.value            = value_of(target, record);
      sample.folder           = "runs/" + run.folder;
      sample.kept             = record.kept;
      const auto fell         = result_named(record, "complete_failure");
      const auto share        = result_named(record, "failed_share");
      sample.complete_failure = fell.value_or(1.) != 0.;
      if (share && *share == 0. && fell.value_or(0.) == 0.)
        throw NumericalError(
            begin + "gave no strength: nothing failed up to its end, at " +
            number_text(sample.value) + " Pa of " + number_text(target.value) +
            " Pa; let it go on further (Time/End time, Stop/Maximum closure), "
            "or check the target.");
      if (!(sample.value > 0.) || !std::isfinite(sample.value))
        throw NumericalError(begin + "gave " + number_text(sample.value) +
                             " for the " + target.name +
                             ", which must be above 0.");
      return sample;
    }
  } // namespace


  double
  Round::largest_error() const
  {
    double largest = 0.;
    for (const Measurement &m : targets)
      largest = std::max(largest, std::abs(m.error));
    return largest;
  }


  Measurement
  measurement_of(std::vector<Sample> samples, const double target)
  {
    std::vector<double> values;
    for (const Sample &sample : samples)
      values.push_back(sample.value);
    const Study::Statistics s = Study::statistics_of(values);
    Measurement             measurement;
    measurement.samples = std::move(samples);
    measurement.mean    = s.mean;
    measurement.error   = s.mean / target - 1.;
    if (s.n > 1)
      {
        measurement.deviation      = s.sd / s.mean;
        measurement.standard_error = s.sd / s.mean / std::sqrt(s.n);
      }
    return measurement;
  }


  void
  carry_out(const Problem                                  &problem,
            const unsigned int                              number,
            Round                                          &round,
            const std::string                              &folder,
            const unsigned int                              threads,
            const std::function<void(const std::string &)> &tell)
  {
    const Study::Study study      = study_of(problem, threads);
    const auto         runs       = runs_of(problem, number, round);
    const auto         parameters = parameters_of(problem, runs);
    Study::Runner      runner(study, runs, parameters, folder);
    runner.run([&](const unsigned int r) {
      const Study::Record &record = runner.get_records()[r];
      // A mistake that all runs share shows in the first one.
      tell(runs[r].label + ": " +
           (record.state == Study::Record::State::finished
                ? number_text(
                      value_of(problem.targets[runs[r].series], record)) +
                      " Pa"
                : "failed"));
    });
    round.targets.clear();
    for (unsigned int t = 0; t < problem.targets.size(); ++t)
      {
        std::vector<Sample> samples;
        for (unsigned int r = 0; r < runs.size(); ++r)
          if (runs[r].series == t)
            samples.push_back(sample_of(problem.targets[t],
                                        runs[r],
                                        problem.first_seed + samples.size(),
                                        runner.get_records()[r]));
        round.targets.push_back(
            measurement_of(samples, problem.targets[t].value));
      }
  }
} // namespace Morsel::Calibrate
