#include <morsel/core/atomic_file.h>
#include <morsel/core/build.h>
#include <morsel/core/errors.h>
#include <morsel/core/signals.h>
#include <morsel/study/runner.h>

#include <filesystem>
#include <set>

#include <unistd.h>

namespace Morsel::Study
{
  namespace fs = std::filesystem;

  namespace
  {
    /// What must be as it was for an old record to hold: program, scene, and
    /// what its times depend on.
    std::string
    fingerprint_of(const Study &study, const std::string &parameters)
    {
      return text_hash(std::string(MORSEL_VERSION) + "\n" + parameters + "\n" +
                       study.time_result + "\n" +
                       std::to_string(study.threads) + " " +
                       std::to_string(study.timing ? study.repetitions : 0));
    }
  } // namespace


  Runner::Runner(const Study                    &study,
                 const std::vector<PlannedRun>  &runs,
                 const std::vector<std::string> &parameters,
                 const std::string              &output)
      : study(study)
      , runs(runs)
      , output(output)
      , records(runs.size())
  {
    create_folder(output + "/runs");
    for (unsigned int r = 0; r < runs.size(); ++r)
      {
        const std::string fingerprint = fingerprint_of(study, parameters[r]);
        if (const auto record = load_finished(folder_of(r), fingerprint))
          records[r] = *record;
        else
          records[r].fingerprint = fingerprint;
      }
  }


  std::list<unsigned int>
  Runner::waiting_runs() const
  {
    std::set<unsigned int>  shown;
    std::list<unsigned int> first, others;
    for (unsigned int r = 0; r < runs.size(); ++r)
      if (const bool is_first = shown.insert(runs[r].series).second;
          records[r].state != Record::State::finished)
        (is_first ? first : others).push_back(r);
    first.splice(first.end(), others);
    return first;
  }


  std::unique_ptr<ChildProcess>
  Runner::start(const unsigned int run) const
  {
    const std::string folder = folder_of(run);
    fs::remove_all(folder);
    create_folder(folder);
    std::vector<std::string> arguments = {
        study.series[runs[run].series].base_scene,
        "--output",
        folder,
        "--quiet",
        "--threads",
        std::to_string(study.threads)};
    for (const std::string &text : runs[run].overrides)
      {
        arguments.push_back("--set");
        arguments.push_back(text);
      }
    return std::make_unique<ChildProcess>(
        arguments, messages_of(run), study.time_limit);
  }


  bool
  Runner::take_results(const unsigned int run, const Ended &ended)
  {
    const std::string folder = folder_of(run);
    Record           &record = records[run];
    record.wall_time         = ended.wall_time;
    record.cpu_time          = ended.cpu_time;
    try
      {
        if (ended.status == 0)
          record.results = read_results(folder);
        else
          record.message = failure_of(ended, messages_of(run));
      }
    catch (const FileError &error)
      {
        record.message = error.what();
      }
    if (!record.message.empty())
      {
        record.state = Record::State::failed;
        save(record, folder);
        return true;
      }
    fs::remove(messages_of(run));
    const auto time = record.results.find(study.time_result);
    if (time != record.results.end())
      record.times.push_back(time->second.value);
    if (!study.keep_fields)
      fs::remove_all(folder + "/solution");
    if (study.timing && record.times.size() < study.repetitions &&
        time != record.results.end())
      return false;
    record.state = Record::State::finished;
    save(record, folder);
    return true;
  }


  void
  Runner::run(const std::function<void(unsigned int)> &after_each)
  {
    const unsigned int      places  = study.timing ? 1 : study.side_by_side;
    std::list<unsigned int> waiting = waiting_runs();
    std::list<Active>       active;
    while (!waiting.empty() || !active.empty())
      {
        if (interrupt_requested())
          throw Interrupted(
              "Interrupted; the runs that have finished are kept, "
              "and the same command goes on from there.");
        while (!waiting.empty() && active.size() < places)
          {
            active.push_back({waiting.front(), start(waiting.front())});
            waiting.pop_front();
          }
        for (auto i = active.begin(); i != active.end();)
          {
            const auto ended = i->process->poll();
            const auto run   = i->run;
            if (!ended)
              ++i;
            else if (!take_results(run, *ended))
              (i++)->process = start(run);
            else
              {
                i = active.erase(i);
                after_each(run);
              }
          }
        ::usleep(2000);
      }
  }


  std::string
  Runner::folder_of(const unsigned int run) const
  {
    return output + "/runs/" + runs[run].folder;
  }


  std::string
  Runner::messages_of(const unsigned int run) const
  {
    return folder_of(run) + ".messages";
  }
} // namespace Morsel::Study
