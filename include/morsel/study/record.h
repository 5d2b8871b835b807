#ifndef morsel_study_record_h
#define morsel_study_record_h

#include <morsel/study/design.h>
#include <morsel/study/process.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Morsel::Study
{
  /// A scalar of a run's summary.json.
  struct Result
  {
    double                value = 0.;
    std::string           unit;
    std::string           meaning;
    std::optional<double> reference;
  };

  using Results = std::map<std::string, Result>;


  /// What became of one run.
  struct Record
  {
    enum class State
    {
      not_run,
      finished,
      failed
    };
    State       state = State::not_run;
    std::string message;      ///< why it failed: "status 3: ..."
    std::string fingerprint;  ///< of scene, program and way of running
    bool        kept = false; ///< from an earlier call

    std::vector<double> times;          ///< one each repetition [s]
    double              wall_time = 0.; ///< of the last process [s]
    double              cpu_time  = 0.; ///< of the last process [s]
    Results             results;        ///< of the last repetition
  };


  /// All parameters of a run's scene as a text, read and checked as the run
  /// itself will do, so that changes in the base scene or in the catalogue
  /// show.
  /// @throw InputError if an entry is unknown or its value not allowed
  std::string
  scene_parameters(const std::string              &scene_file,
                   const std::vector<std::string> &overrides);


  /// The values of a scene's entries by path, "Body food/Solid/CFL factor",
  /// with those of the catalogue.
  /// @throw InputError as scene_parameters()
  std::map<std::string, std::string>
  scene_values(const std::string              &scene_file,
               const std::vector<std::string> &overrides);


  /// The scalars that a run left in its folder.
  /// @throw FileError if there are none
  Results
  read_results(const std::string &folder);


  /// Keeps the record in the folder of its run.
  void
  save(const Record &record, const std::string &folder);


  /// The finished record of a run's folder, if it has this fingerprint.
  std::optional<Record>
  load_finished(const std::string &folder, const std::string &fingerprint);


  /// Why a process failed, from how it ended and the last thing that it said.
  std::string
  failure_of(const Ended &ended, const std::string &output_file);


  const char *
  name_of(Record::State state);
} // namespace Morsel::Study

#endif
