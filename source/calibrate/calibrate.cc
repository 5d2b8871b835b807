#include <morsel/calibrate/calibrate.h>
#include <morsel/calibrate/outcome.h>
#include <morsel/calibrate/search.h>
#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/signals.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/run_study.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace Morsel::Calibrate
{
  namespace
  {
    /// Thresholds are c w/b in terms of the compressive strength and the
    /// tensile strength is that over the ratio k: f_c goes with c, f_t with
    /// c/k.
    Search
    search_of(const Problem &problem)
    {
      if (problem.targets.size() == 1)
        return Search({problem.damage.threshold_factor}, {{1.}});
      return Search(
          {problem.damage.threshold_factor, problem.damage.strength_ratio},
          {{1., 0.}, {1., -1.}});
    }


    Round
    round_of(const Problem &problem, const Search &search)
    {
      Round round;
      round.threshold_factor = search.parameters().front();
      round.strength_ratio   = problem.targets.size() > 1
                                   ? search.parameters().back()
                                   : problem.damage.strength_ratio;
      if (round.strength_ratio < 1.)
        throw NumericalError("--calibrate: the tensile strength asked for "
                             "needs a strength ratio below 1, and the law has "
                             "none; check 'Calibration/Tensile strength' and "
                             "what the two scenes measure.");
      return round;
    }


    std::string
    description_of(const Problem &problem)
    {
      std::string text =
          "Calibration of '" + problem.name + "', body '" + problem.body +
          "', " + std::to_string(problem.particles_across) +
          " particles across, " + std::to_string(problem.parameters.seeds) +
          (problem.parameters.seeds == 1 ? " seed" : " seeds") +
          ", tolerance " + number_text(problem.parameters.tolerance) + "\n";
      for (const Target &target : problem.targets)
        text += "Target: " + target.name + " " + number_text(target.value) +
                " Pa, from '" + target.result + "' of " + target.scene + "\n";
      return text;
    }


    unsigned int
    n_kept(const Round &round)
    {
      unsigned int n = 0;
      for (const Measurement &m : round.targets)
        n += std::count_if(m.samples.begin(),
                           m.samples.end(),
                           [](const Sample &sample) { return sample.kept; });
      return n;
    }


    void
    warn_of_incomplete_failure(const Round &round, RunLog &log)
    {
      for (const Measurement &m : round.targets)
        for (const Sample &sample : m.samples)
          if (!sample.complete_failure)
            log.warning(sample.folder +
                        ": the force did not fall to its residual share, so "
                        "that a later peak may have been missed.");
    }


    void
    tell(const Problem &problem, const Round &round, RunLog &log)
    {
      log << line_of(problem, round);
      if (const unsigned int kept = n_kept(round); kept > 0)
        log << ", " << kept << " runs kept from before";
      log << std::endl;
      warn_of_incomplete_failure(round, log);
    }


    /// Rounds until the targets are met, with the results on the disk after
    /// every one.
    Outcome
    carry_out_rounds(const Problem     &problem,
                     const std::string &folder,
                     const unsigned int threads,
                     RunLog            &log)
    {
      Search  search = search_of(problem);
      Outcome outcome;
      while (!outcome.converged &&
             outcome.rounds.size() < problem.parameters.rounds)
        {
          Round              round  = round_of(problem, search);
          const unsigned int number = outcome.rounds.size() + 1;
          carry_out(problem,
                    number,
                    round,
                    folder,
                    threads,
                    [&](const std::string &line) { log << line << std::endl; });
          log << "Round " << number << ": ";
          tell(problem, round, log);
          std::vector<double> ratios;
          for (const Measurement &m : round.targets)
            ratios.push_back(1. + m.error);
          search.take(ratios);
          outcome.converged =
              round.largest_error() <= problem.parameters.tolerance;
          outcome.rounds.push_back(std::move(round));
          write_atomically(folder + "/calibration.json",
                           calibration_json(problem, outcome).dump(2) + "\n");
        }
      return outcome;
    }
  } // namespace


  void
  run_calibration(const CommandLine &command_line)
  {
    Study::refuse_several_ranks("A calibration", "Calibration");
    const Problem problem = read_problem(command_line);
    if (command_line.run.validate_only)
      {
        std::cout << description_of(problem) << std::flush;
        return;
      }
    const std::string folder = command_line.run.output_directory.empty()
                                   ? "output/" + problem.name + "_calibration"
                                   : command_line.run.output_directory;
    prepare_output_directory(folder);
    RunLog log(folder + "/run.log", command_line.run.quiet, true);
    log << description_of(problem) << std::flush;
    catch_signals();
    const Outcome outcome = carry_out_rounds(
        problem, folder, std::max(1u, command_line.run.threads), log);
    log << conclusion(problem, outcome) << std::flush;
    if (!outcome.converged)
      throw NumericalError(
          "--calibrate: after " + std::to_string(outcome.rounds.size()) +
          (outcome.rounds.size() == 1 ? " round" : " rounds") +
          " the best is still " +
          number_text(100. * outcome.best().largest_error()) +
          " % from its target, the tolerance being " +
          number_text(100. * problem.parameters.tolerance) +
          " %; allow more rounds (Calibration/Largest number of rounds), or a "
          "larger tolerance.");
  }
} // namespace Morsel::Calibrate
