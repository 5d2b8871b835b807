// Runs a scene of the stability suite, in one or several variants, and checks
// its criteria. They stand in comments at the head of the scene:
//   # run: NAME [Section/Key = value; ...]   a variant, and what it changes
//       (';;' is a semicolon in a value)
//   # ends: NAME STATUS[|STATUS] [REGEX]     how it may end, and what it says
//   then # holds: FORMULA < FORMULA               also >, <=, >= and == #
//   scaled: NAME length I mass J time K    its results are those of the first
//       variant, bit by bit, with the units times 2^I, 2^J and 2^K
// Without a run there is one, 'scene', that changes nothing; without another
// word a run ends with status 0. Formulas name results of summary.json, or
// first_X, highest_X and lowest_X of a column X of history.csv; RUN.result is
// that of one run, a formula without such names holds in every run that
// finished. What ends otherwise must say so in a sentence, and bad input leaves
// no folder.
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture_run.h>
#include <morsel/scene/read.h>
#include <morsel/simulation.h>
#include <morsel/study/formula.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <sstream>

namespace
{
  using namespace Morsel;

  struct Run
  {
    std::string              name;
    std::vector<std::string> overrides;
    std::vector<int>         allowed = {0};
    std::string              pattern; ///< of what it says
    int                      status = 0;
    std::string              said;
    nlohmann::json           summary;
    Study::Variables         results;
  };


  struct Scaled
  {
    std::string        name;
    std::array<int, 3> powers; ///< of two: length, mass, time
  };


  struct Case
  {
    std::vector<Run>         runs;
    std::vector<std::string> formulas;
    std::vector<Scaled>      scaled;

    Run &
    run_named(const std::string &name)
    {
      for (Run &run : runs)
        if (run.name == name)
          return run;
      throw InputError("there is no run '" + name + "'");
    }
  };


  std::string
  content(const std::string &file_name)
  {
    std::ifstream file(file_name);
    return {std::istreambuf_iterator<char>(file),
            std::istreambuf_iterator<char>()};
  }


  Run
  run_from(std::istringstream &words)
  {
    Run         run;
    std::string rest;
    words >> run.name;
    std::getline(words, rest);
    // A doubled semicolon is one in a text.
    rest = std::regex_replace(rest, std::regex(";;"), "\x01");
    for (std::string entry : dealii::Utilities::split_string_list(rest, ';'))
      {
        std::replace(entry.begin(), entry.end(), '\x01', ';');
        const std::size_t equals = entry.find('=');
        run.overrides.push_back(trimmed(entry.substr(0, equals)) + "=" +
                                trimmed(entry.substr(equals + 1)));
      }
    return run;
  }


  void
  read_end(std::istringstream &words, Case &result)
  {
    std::string name, statuses;
    words >> name >> statuses;
    Run &run = result.run_named(name);
    run.allowed.clear();
    for (const std::string &status :
         dealii::Utilities::split_string_list(statuses, '|'))
      run.allowed.push_back(std::stoi(status));
    std::getline(words, run.pattern);
    run.pattern = trimmed(run.pattern);
  }


  Case
  read_case(const std::string &scene_file)
  {
    Case          result;
    std::ifstream scene(scene_file);
    for (std::string line; std::getline(scene, line);)
      {
        std::istringstream words(line);
        std::string        hash, kind, unit;
        words >> hash >> kind;
        if (hash != "#")
          continue;
        if (kind == "run:")
          result.runs.push_back(run_from(words));
        else if (result.runs.empty() &&
                 (kind == "ends:" || kind == "holds:" || kind == "scaled:"))
          {
            std::istringstream plain("scene");
            result.runs.push_back(run_from(plain));
          }
        if (kind == "ends:")
          read_end(words, result);
        else if (kind == "holds:")
          {
            std::getline(words, line);
            result.formulas.push_back(trimmed(line));
          }
        else if (kind == "scaled:")
          {
            Scaled s;
            words >> s.name;
            for (int &power : s.powers)
              words >> unit >> power;
            if (!words)
              throw InputError("'" + line + "' is not understood");
            result.scaled.push_back(s);
          }
      }
    if (result.runs.empty())
      throw InputError("'" + scene_file + "' states no criterion");
    return result;
  }


  /// First value and extremes of every column, named without its unit.
  void
  read_history(const std::string &file_name, Study::Variables &results)
  {
    std::ifstream            file(file_name);
    std::string              line;
    std::vector<std::string> names;
    if (std::getline(file, line))
      names = dealii::Utilities::split_string_list(line, ',');
    while (std::getline(file, line))
      {
        const auto values = dealii::Utilities::split_string_list(line, ',');
        for (std::size_t c = 0; c < names.size(); ++c)
          {
            const std::string name  = names[c].substr(0, names[c].find(' '));
            const double      value = std::stod(values.at(c));
            results.emplace("first_" + name, value);
            const auto high = results.emplace("highest_" + name, value).first;
            const auto low  = results.emplace("lowest_" + name, value).first;
            high->second    = std::max(high->second, value);
            low->second     = std::min(low->second, value);
          }
      }
  }


  void
  carry_out(const std::string &scene_file, Run &run)
  {
    std::filesystem::remove_all(run.name);
    CommandLine command_line;
    command_line.scene_file           = scene_file;
    command_line.overrides            = run.overrides;
    command_line.run.output_directory = run.name;
    command_line.run.quiet            = true;

    const std::ostringstream said;
    std::streambuf *const    before = std::cerr.rdbuf(said.rdbuf());
    run.status                      = exit_status_of([&] {
      if (is_fracture_scene(scene_file, run.overrides))
        run_fracture_scene(command_line);
      else
        run_simulation(Scene::read_scene(scene_file, run.overrides),
                       command_line.run);
    });
    std::cerr.rdbuf(before);
    run.said = said.str();
    if (run.status != 0)
      return;
    run.summary = nlohmann::json::parse(content(run.name + "/summary.json"));
    for (const auto &[name, entry] : run.summary.items())
      if (entry.is_object() && entry.contains("value"))
        run.results[name] = entry["value"].get<double>();
    read_history(run.name + "/history.csv", run.results);
  }


  bool
  check_end(const Run &run)
  {
    std::cout << run.name << ": status " << run.status << std::endl << run.said;
    bool good = true;
    if (std::find(run.allowed.begin(), run.allowed.end(), run.status) ==
        run.allowed.end())
      {
        std::cout << "  FAILED: no such end is allowed\n";
        good = false;
      }
    if (run.status != 0 &&
        (run.said.empty() ||
         std::count(run.said.begin(), run.said.end(), '\n') > 4))
      {
        std::cout << "  FAILED: that is no sentence\n";
        good = false;
      }
    if (run.status == 2 && std::filesystem::exists(run.name))
      {
        std::cout << "  FAILED: bad input, and yet something was written\n";
        good = false;
      }
    // Where both ends are good, the sentence belongs to the bad one.
    const bool speaks = run.status != 0 || run.allowed.size() == 1;
    if (speaks && !run.pattern.empty() &&
        !std::regex_search(run.said + content(run.name + "/run.log"),
                           std::regex(run.pattern)))
      {
        std::cout << "  FAILED: nothing matches '" << run.pattern << "'\n";
        good = false;
      }
    return good;
  }


  bool
  compare(const std::string &relation, const double left, const double right)
  {
    if (relation == "==")
      return left == right;
    if (relation == "<=")
      return left <= right;
    if (relation == ">=")
      return left >= right;
    return relation == "<" ? left < right : left > right;
  }


  bool
  check_formula(const std::string      &formula,
                const Study::Variables &variables,
                const std::string      &run)
  {
    const std::size_t at = formula.find_first_of("<>=");
    if (at == std::string::npos)
      throw InputError("'" + formula + "' compares nothing");
    const bool        two      = formula.substr(at + 1, 1) == "=";
    const std::string relation = formula.substr(at, two ? 2 : 1);
    const double      left = Study::evaluate(formula.substr(0, at), variables);
    const double      right =
        Study::evaluate(formula.substr(at + relation.size()), variables);
    const bool good = compare(relation, left, right);
    std::cout << (good ? "" : "  FAILED: ") << run << formula << "   [" << left
              << ' ' << relation << ' ' << right << "]\n";
    return good;
  }


  bool
  check_formula(const std::string &formula, const Case &of)
  {
    // RUN.result becomes a name that the parser takes.
    static const std::regex qualified("([A-Za-z_]\\w*)\\.([A-Za-z_]\\w*)");
    if (!std::regex_search(formula, qualified))
      {
        bool good = true;
        for (const Run &run : of.runs)
          if (run.status == 0)
            good &= check_formula(formula,
                                  run.results,
                                  of.runs.size() > 1 ? run.name + ": " : "");
        return good;
      }
    for (std::sregex_iterator i(formula.begin(), formula.end(), qualified), end;
         i != end;
         ++i)
      for (const Run &run : of.runs)
        if (run.name == (*i)[1] && run.status != 0)
          return true; // its end was allowed
    Study::Variables all;
    for (const Run &run : of.runs)
      for (const auto &[name, value] : run.results)
        all[run.name + "__" + name] = value;
    return check_formula(
        std::regex_replace(formula, qualified, "$1__$2"), all, "");
  }


  /// Twice the powers of length, mass and time in a unit.
  std::array<int, 3>
  dimension(const std::string &unit)
  {
    static const std::map<std::string, std::array<int, 3>> known = {
        {"1", {{0, 0, 0}}},          {"degrees", {{0, 0, 0}}},
        {"m", {{2, 0, 0}}},          {"m^2", {{4, 0, 0}}},
        {"m^2/J", {{0, -2, 4}}},     {"kg/m^3", {{-6, 2, 0}}},
        {"N m", {{4, 2, -4}}},       {"s", {{0, 0, 2}}},
        {"1/s", {{0, 0, -2}}},       {"m/s", {{2, 0, -2}}},
        {"kg", {{0, 2, 0}}},         {"N", {{2, 2, -4}}},
        {"N s", {{2, 2, -2}}},       {"N/m", {{0, 2, -4}}},
        {"Pa", {{-2, 2, -4}}},       {"J", {{4, 2, -4}}},
        {"J/m", {{2, 2, -4}}},       {"J/m^2", {{0, 2, -4}}},
        {"J/m^3", {{-2, 2, -4}}},    {"Pa sqrt(m)", {{-1, 2, -4}}},
        {"1/sqrt(mm)", {{-1, 0, 0}}}};
    const auto found = known.find(unit);
    if (found == known.end())
      throw InputError("the dimension of '" + unit + "' is not known here");
    return found->second;
  }


  bool
  check_scaled(const Run &run, const Run &first, const Scaled &scaled)
  {
    // What depends on the machine, not on the scene.
    static const std::regex machine("wall_time.*|.*_per_second|peak_memory");
    unsigned int            n_equal = 0;
    bool                    good    = true;
    for (const auto &[name, entry] : first.summary.items())
      {
        if (!entry.is_object() || !entry.contains("value") ||
            std::regex_match(name, machine))
          continue;
        const auto powers = dimension(entry["unit"]);
        int        power  = 0;
        for (unsigned int d = 0; d < 3; ++d)
          power += powers[d] * scaled.powers[d];
        const double expected =
            std::ldexp(entry["value"].get<double>(), power / 2);
        const auto found = run.results.find(name);
        if (power % 2 == 0 && found != run.results.end() &&
            found->second == expected)
          ++n_equal;
        else
          {
            good = false;
            std::cout << "  FAILED: " << name << " of " << run.name;
            if (found == run.results.end())
              std::cout << " is missing\n";
            else
              std::cout << " is off by "
                        << (found->second - expected) / std::abs(expected)
                        << '\n';
          }
      }
    std::cout << run.name << ": " << n_equal << " results equal those of "
              << first.name << " bit by bit\n";
    return good;
  }


  bool
  check_case(const std::string &scene_file)
  {
    Case of   = read_case(scene_file);
    bool good = true;
    for (Run &run : of.runs)
      {
        carry_out(scene_file, run);
        good &= check_end(run);
      }
    for (const std::string &formula : of.formulas)
      good &= check_formula(formula, of);
    for (const Scaled &scaled : of.scaled)
      good &= check_scaled(of.run_named(scaled.name), of.runs.front(), scaled);
    return good;
  }
} // namespace


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool                                           good   = false;
  const int                                      status = exit_status_of([&] {
    if (argc != 2)
      throw std::runtime_error("call: stability_case SCENE.prm");
    good = check_case(argv[1]);
  });
  return status != 0 ? status : !good;
}
