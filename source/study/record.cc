#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture_run.h>
#include <morsel/scene/read.h>
#include <morsel/study/record.h>

#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    /// The file's JSON, or null.
    ordered_json
    read_json(const std::string &file_name)
    {
      std::ifstream file(file_name);
      return file ? ordered_json::parse(file, nullptr, false)
                  : ordered_json(nullptr);
    }


    /// The entries with a number as "value".
    Results
    results_of(const ordered_json &document)
    {
      Results results;
      for (const auto &[name, entry] : document.items())
        if (entry.is_object() && entry.contains("value") &&
            entry["value"].is_number())
          {
            Result &result = results[name];
            result.value   = entry["value"];
            result.unit    = entry.value("unit", "1");
            result.meaning = entry.value("meaning", "");
            if (entry.contains("reference") && entry["reference"].is_number())
              result.reference = entry["reference"].get<double>();
          }
      return results;
    }


    ordered_json
    json_of(const Results &results)
    {
      ordered_json document = ordered_json::object();
      for (const auto &[name, result] : results)
        {
          document[name] = {{"value", result.value},
                            {"unit", result.unit},
                            {"meaning", result.meaning}};
          if (result.reference)
            document[name]["reference"] = *result.reference;
        }
      return document;
    }


    /// All parameters of a cracked plate.
    std::string
    parameters_of_plate(const std::string              &scene_file,
                        const std::vector<std::string> &overrides,
                        const std::string              &format)
    {
      CommandLine command_line;
      command_line.scene_file       = scene_file;
      command_line.overrides        = overrides;
      command_line.print_parameters = format;
      return fracture_parameters(command_line);
    }
  } // namespace


  std::string
  scene_parameters(const std::string              &scene_file,
                   const std::vector<std::string> &overrides)
  {
    if (is_fracture_scene(scene_file, overrides))
      return parameters_of_plate(scene_file, overrides, "prm");
    // With the catalogue's values.
    return Scene::read_scene(scene_file, overrides).used_parameters;
  }


  std::map<std::string, std::string>
  scene_values(const std::string              &scene_file,
               const std::vector<std::string> &overrides)
  {
    const std::string text =
        is_fracture_scene(scene_file, overrides)
            ? parameters_of_plate(scene_file, overrides, "json")
            : Scene::print_parameters(
                  Scene::ParameterFormat::json, scene_file, overrides);
    std::map<std::string, std::string> values;
    for (const ordered_json &entry : ordered_json::parse(text))
      {
        const std::string section                 = entry["section"];
        values[(section.empty() ? "" : section + "/") +
               entry["entry"].get<std::string>()] = entry["value"];
      }
    return values;
  }


  Results
  read_results(const std::string &folder)
  {
    const ordered_json document = read_json(folder + "/summary.json");
    if (!document.is_object())
      throw FileError("The run left no readable '" + folder +
                      "/summary.json'.");
    return results_of(document);
  }


  void
  save(const Record &record, const std::string &folder)
  {
    const ordered_json document = {{"state", name_of(record.state)},
                                   {"message", record.message},
                                   {"fingerprint", record.fingerprint},
                                   {"times", record.times},
                                   {"wall_time", record.wall_time},
                                   {"cpu_time", record.cpu_time},
                                   {"results", json_of(record.results)}};
    write_atomically(
        folder + "/record.json",
        document.dump(2, ' ', false, ordered_json::error_handler_t::replace) +
            "\n");
  }


  std::optional<Record>
  load_finished(const std::string &folder, const std::string &fingerprint)
  {
    const ordered_json document = read_json(folder + "/record.json");
    if (!document.is_object() ||
        document.value("fingerprint", "") != fingerprint ||
        document.value("state", "") != name_of(Record::State::finished))
      return std::nullopt;
    Record record;
    record.state       = Record::State::finished;
    record.fingerprint = fingerprint;
    record.kept        = true;
    record.times       = document.value("times", std::vector<double>());
    record.wall_time   = document.value("wall_time", 0.);
    record.cpu_time    = document.value("cpu_time", 0.);
    record.results =
        results_of(document.value("results", ordered_json::object()));
    return record;
  }


  std::string
  failure_of(const Ended &ended, const std::string &output_file)
  {
    if (ended.too_long)
      return "it took longer than the time limit";
    if (ended.status < 0)
      return std::string("signal ") + std::to_string(-ended.status) + " (" +
             strsignal(-ended.status) + ") ended it";
    std::string   sentence;
    std::ifstream file(output_file);
    for (std::string line; std::getline(file, line);)
      {
        const bool own = line.rfind("morsel: ", 0) == 0;
        if (own || sentence.empty())
          sentence = trimmed(own ? line.substr(8) : line);
      }
    return "status " + std::to_string(ended.status) + ": " +
           (sentence.empty() ? "it gave no reason" : sentence);
  }


  const char *
  name_of(const Record::State state)
  {
    switch (state)
      {
        case Record::State::finished:
          return "finished";
        case Record::State::failed:
          return "failed";
        default:
          return "not run";
      }
  }
} // namespace Morsel::Study
