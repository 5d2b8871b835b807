#include <morsel/calibrate/outcome.h>
#include <morsel/core/build.h>
#include <morsel/core/suggestions.h>
#include <morsel/materials/catalogue.h>
#include <morsel/study/optional_json.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Morsel::Calibrate
{
  using nlohmann::ordered_json;
  using Study::json_of;

  namespace
  {
    bool
    has_tension(const Problem &problem)
    {
      return problem.targets.size() > 1;
    }


    /// "1.3 %", with a sign if it is an error.
    std::string
    percent(const double share, const bool is_error)
    {
      char text[32];
      std::snprintf(
          text, sizeof(text), is_error ? "%+.2g %%" : "%.2g %%", 100. * share);
      return text;
    }


    /// "101.3 kPa".
    std::string
    stress_text(const double value)
    {
      char text[32];
      if (value >= 1e6)
        std::snprintf(text, sizeof(text), "%.4g MPa", 1e-6 * value);
      else
        std::snprintf(text, sizeof(text), "%.4g kPa", 1e-3 * value);
      return text;
    }


    std::string
    parameters_text(const Problem &problem, const Round &round)
    {
      return "Threshold factor " + number_text(round.threshold_factor) +
             (has_tension(problem)
                  ? " and strength ratio " + number_text(round.strength_ratio)
                  : "");
    }


    ordered_json
    measurement_json(const Target &target, const Measurement &measurement)
    {
      ordered_json runs = ordered_json::array();
      for (const Sample &sample : measurement.samples)
        runs.push_back({{"seed", sample.seed},
                        {"strength", sample.value},
                        {"complete_failure", sample.complete_failure},
                        {"kept", sample.kept},
                        {"folder", sample.folder}});
      return {{"target", target.name},
              {"mean", measurement.mean},
              {"error", measurement.error},
              {"deviation", json_of(measurement.deviation)},
              {"standard_error", json_of(measurement.standard_error)},
              {"runs", runs}};
    }


    ordered_json
    targets_json(const Problem &problem)
    {
      ordered_json list = ordered_json::array();
      for (const Target &target : problem.targets)
        list.push_back({{"name", target.name},
                        {"value", target.value},
                        {"unit", "Pa"},
                        {"scene", target.scene},
                        {"result", target.result}});
      return list;
    }


    ordered_json
    round_json(const Problem &problem, const Round &round)
    {
      ordered_json targets = ordered_json::array();
      for (unsigned int t = 0; t < problem.targets.size(); ++t)
        targets.push_back(
            measurement_json(problem.targets[t], round.targets[t]));
      return {{"threshold_factor", round.threshold_factor},
              {"strength_ratio", round.strength_ratio},
              {"targets", targets}};
    }


    std::string
    scene_lines(const Problem &problem, const Round &round)
    {
      return "  subsection Body " + problem.body + "\n" +
             "    subsection Damage\n" + "      set Threshold factor = " +
             number_text(round.threshold_factor) + "\n" +
             (has_tension(problem)
                  ? "      set Strength ratio = " +
                        number_text(round.strength_ratio) + "\n"
                  : "") +
             "    end\n  end\n";
    }


    /// How well a mean is known.
    std::string
    scatter_text(const std::string &name,
                 const Measurement &measurement,
                 const double       tolerance)
    {
      if (!measurement.standard_error)
        return "One seed tells nothing about the scatter: other seeds may well "
               "be several per cent off.";
      const double error = *measurement.standard_error;
      std::string  text  = "The " + name + " scatters over the seeds by " +
                         percent(*measurement.deviation, false) +
                         ", so the mean has a standard error of " +
                         percent(error, false);
      if (error <= tolerance)
        return text + ".";
      const double ratio = *measurement.deviation / tolerance;
      return text + ", more than the tolerance of " +
             percent(tolerance, false) +
             ": with other seeds it will differ by about as much; some " +
             std::to_string(
                 static_cast<unsigned int>(std::ceil(ratio * ratio))) +
             " seeds would make the two equal.";
    }
  } // namespace


  const Round &
  Outcome::best() const
  {
    return converged ? rounds.back()
                     : *std::min_element(rounds.begin(),
                                         rounds.end(),
                                         [](const auto &a, const auto &b) {
                                           return a.largest_error() <
                                                  b.largest_error();
                                         });
  }


  ordered_json
  catalogue_damage(const Problem &problem, const Round &round)
  {
    Materials::CatalogueDamage damage;
    damage.threshold_factor = round.threshold_factor;
    damage.weibull_modulus  = problem.damage.weibull_modulus;
    damage.strength_ratio   = round.strength_ratio;
    damage.fracture_energy  = problem.damage.fracture_energy;
    damage.flaws            = problem.damage.flaws;
    if (problem.damage.flaws == "correlated")
      damage.correlation_length = problem.damage.correlation_length;
    damage.scene            = problem.file;
    damage.particles_across = problem.particles_across;
    damage.seeds            = problem.parameters.seeds;
    return Materials::as_json(damage);
  }


  ordered_json
  calibration_json(const Problem &problem, const Outcome &outcome)
  {
    ordered_json rounds = ordered_json::array();
    for (const Round &round : outcome.rounds)
      rounds.push_back(round_json(problem, round));
    const Round &best = outcome.best();
    return {{"scene", problem.file},
            {"body", problem.body},
            {"material", problem.material.name},
            {"program_version", MORSEL_VERSION},
            {"converged", outcome.converged},
            {"threshold_factor", best.threshold_factor},
            {"strength_ratio", best.strength_ratio},
            {"particles_across", problem.particles_across},
            {"first_seed", problem.first_seed},
            {"seeds", problem.parameters.seeds},
            {"tolerance", problem.parameters.tolerance},
            {"targets", targets_json(problem)},
            {"rounds", rounds},
            {"damage", catalogue_damage(problem, best)}};
  }


  std::string
  line_of(const Problem &problem, const Round &round)
  {
    std::string text = parameters_text(problem, round) + ": ";
    for (unsigned int t = 0; t < problem.targets.size(); ++t)
      {
        const Measurement &m = round.targets[t];
        text += (t > 0 ? ", " : "") + problem.targets[t].name + " " +
                stress_text(m.mean) + " (" + percent(m.error, true) +
                (m.standard_error
                     ? ", standard error " + percent(*m.standard_error, false)
                     : "") +
                ")";
      }
    return text;
  }


  std::string
  conclusion(const Problem &problem, const Outcome &outcome)
  {
    const Round &round = outcome.best();
    std::string  text  = parameters_text(problem, round) +
                       (has_tension(problem) ? " give" : " gives");
    for (unsigned int t = 0; t < problem.targets.size(); ++t)
      text += std::string(t > 0 ? " and" : "") + " the " +
              problem.targets[t].name + " " +
              stress_text(round.targets[t].mean) + ", " +
              percent(round.targets[t].error, true) + " from the " +
              stress_text(problem.targets[t].value) + " asked for";
    text += " (mean of " + std::to_string(problem.parameters.seeds) +
            (problem.parameters.seeds == 1 ? " seed, " : " seeds, ") +
            std::to_string(problem.particles_across) +
            " particles across, round " +
            std::to_string(&round - outcome.rounds.data() + 1) + " of " +
            std::to_string(outcome.rounds.size()) + ").";
    for (unsigned int t = 0; t < problem.targets.size(); ++t)
      text += " " + scatter_text(problem.targets[t].name,
                                 round.targets[t],
                                 problem.parameters.tolerance);
    const std::string entry = problem.material.name == "inline"
                                  ? "an entry of data/materials.json"
                                  : "the entry '" + problem.material.name +
                                        "' of data/materials.json";
    return text + "\nIn a scene:\n" + scene_lines(problem, round) + "In " +
           entry +
           ":\n  \"damage\": " + catalogue_damage(problem, round).dump() + "\n";
  }
} // namespace Morsel::Calibrate
