#include <morsel/calibration.h>
#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/signals.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/results.h>
#include <morsel/study/run_study.h>
#include <morsel/study/runner.h>
#include <morsel/study/sensitivity.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>

namespace Morsel::Study
{
  using nlohmann::ordered_json;

  namespace
  {
    /// The parameters of every run, and with it the check that all entries are
    /// known and their values allowed.
    std::vector<std::string>
    parameters_of(const Study &study, const std::vector<PlannedRun> &runs)
    {
      std::vector<std::string> parameters;
      for (const PlannedRun &run : runs)
        try
          {
            parameters.push_back(scene_parameters(
                study.series[run.series].base_scene, run.overrides));
          }
        catch (const InputError &error)
          {
            throw InputError(study.file + ", run '" + run.label +
                             "': " + error.what());
          }
      return parameters;
    }


    std::string
    description_of(const Study &study, const std::vector<PlannedRun> &runs)
    {
      std::string text =
          "Study '" + study.name +
          "' is sound: " + std::to_string(runs.size()) + " runs" +
          (study.timing ? ", one at a time, each " +
                              std::to_string(study.repetitions) + " times"
                        : ", " +
                              std::to_string(std::min<std::size_t>(
                                  study.side_by_side, runs.size())) +
                              " at a time") +
          ".\n";
      for (unsigned int s = 0; s < study.series.size(); ++s)
        text += "Series '" + study.series[s].name + "': " +
                std::to_string(std::count_if(
                    runs.begin(),
                    runs.end(),
                    [s](const auto &run) { return run.series == s; })) +
                " runs of " + study.series[s].base_scene + "\n";
      return text;
    }


    /// One line about a run that has come to its end.
    std::string
    line_of(const Study &study, const Row &row)
    {
      std::string text = row.run->label + ": ";
      if (row.record->state == Record::State::failed)
        return text + "failed, " + row.record->message;
      for (unsigned int q = 0; q < study.quantities.size(); ++q)
        if (const Measured &m = row.quantities[q]; m.value)
          text += study.quantities[q].name + " = " + number_text(*m.value) +
                  (m.error ? " (error " + number_text(*m.error) + "), " : ", ");
      return text + (row.time ? number_text(*row.time) + " s" : "");
    }


    /// Of this machine, for studies that measure time; that of the results in
    /// the folder, if no run is left that could be measured.
    ordered_json
    calibration_of(const Study               &study,
                   const std::vector<Record> &records,
                   const std::string         &folder)
    {
      if (!study.timing)
        return nullptr;
      if (std::none_of(records.begin(), records.end(), [](const auto &record) {
            return record.state == Record::State::not_run;
          }))
        {
          std::ifstream file(folder + "/study.json");
          const auto    former = ordered_json::parse(file, nullptr, false);
          return former.is_object()
                     ? former.value("calibration", ordered_json(nullptr))
                     : ordered_json(nullptr);
        }
      dealii::MultithreadInfo::set_thread_limit(study.threads);
      return calibration_json();
    }


    void
    write_results(const Study            &study,
                  const std::vector<Row> &rows,
                  const ordered_json     &calibration,
                  const std::string      &folder)
    {
      ordered_json results   = study_json(study, rows);
      results["calibration"] = calibration;
      write_atomically(folder + "/study.csv", study_csv(study, rows));
      write_atomically(
          folder + "/study.json",
          results.dump(2, ' ', false, ordered_json::error_handler_t::replace) +
              "\n");
    }


    void
    log_rates(RunLog &log, const Study &study, const std::vector<Row> &rows)
    {
      const ordered_json results = study_json(study, rows);
      for (const ordered_json &fit : results["rates"])
        {
          log << "Rate of " << fit["quantity"].get<std::string>() << ", "
              << fit["series"].get<std::string>();
          for (const auto &[axis, value] : fit["at"].items())
            log << ", " << axis << " = " << value.get<std::string>();
          log << ": " << number_text(fit["rate"]);
          if (!fit["low"].is_null())
            log << " (95 %: " << number_text(fit["low"]) << " to "
                << number_text(fit["high"]) << ')';
          log << " over " << fit["points"].get<unsigned int>() << " runs\n";
        }
      log << std::flush;
    }


    /// What every variation changes.
    void
    log_sensitivities(RunLog                 &log,
                      const Study            &study,
                      const std::vector<Row> &rows)
    {
      for (const ordered_json &change : sensitivity_changes(study, rows))
        {
          log << "Sensitivity of " << change["quantity"].get<std::string>()
              << ", " << change["series"].get<std::string>() << ": "
              << change["sensitivity"].get<std::string>();
          for (const char *side : {"low", "high"})
            if (const ordered_json &end = change[side]; !end.is_null())
              log << ", " << number_text(end["value"]) << ": "
                  << number_text(100. * end["change"].get<double>()) << " %";
          log << (change["beyond_bound"].get<bool>()
                      ? ", beyond the bound of numerical coefficients\n"
                      : "\n");
        }
      log << std::flush;
    }


    /// Runs what is left, with the results on the disk after every run.
    void
    carry_out_runs(const Study                   &study,
                   const std::vector<PlannedRun> &runs,
                   Runner                        &runner,
                   const std::string             &folder,
                   RunLog                        &log)
    {
      const std::vector<Record> &records = runner.get_records();
      const auto                 is_over = [](const Record &record) {
        return record.state != Record::State::not_run;
      };
      const auto kept = std::count_if(records.begin(), records.end(), is_over);
      log << runs.size() << " runs";
      if (kept > 0)
        log << ", " << kept << " of them kept from before";
      log << std::endl;

      check_results(study, runs, records);
      const ordered_json calibration = calibration_of(study, records, folder);
      write_results(
          study, evaluate_runs(study, runs, records), calibration, folder);
      runner.run([&](const unsigned int run) {
        check_results(study, runs, records);
        const std::vector<Row> rows = evaluate_runs(study, runs, records);
        write_results(study, rows, calibration, folder);
        log << '[' << std::count_if(records.begin(), records.end(), is_over)
            << '/' << runs.size() << "] " << line_of(study, rows[run])
            << std::endl;
      });
    }


    Outcome
    conclude(const Study                   &study,
             const std::vector<PlannedRun> &runs,
             const std::vector<Record>     &records,
             RunLog                        &log)
    {
      Outcome       outcome;
      const Record *failed = nullptr;
      for (const Record &record : records)
        {
          outcome.run_time +=
              record.wall_time * static_cast<double>(std::max<std::size_t>(
                                     1, record.times.size()));
          if (record.state != Record::State::failed)
            continue;
          ++outcome.n_failed;
          if (failed == nullptr)
            failed = &record;
        }
      if (outcome.n_failed == records.size())
        throw NumericalError("No run of the study finished; the first one "
                             "failed with " +
                             failed->message);
      const std::vector<Row> rows = evaluate_runs(study, runs, records);
      log_rates(log, study, rows);
      log_sensitivities(log, study, rows);
      if (outcome.n_failed > 0)
        log.warning(std::to_string(outcome.n_failed) + " of " +
                    std::to_string(records.size()) +
                    " runs failed; study.csv says why.");
      return outcome;
    }
  } // namespace


  void
  refuse_several_ranks(const std::string &what, const std::string &section)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1 ||
        std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr)
      throw InputError(what +
                       " starts its runs itself: start it without "
                       "mpirun, and say in '" +
                       section +
                       "/Side by side' how many runs shall go at a time.");
  }


  PreparedStudy
  prepare_study(const std::string              &file_name,
                const std::vector<std::string> &overrides,
                const unsigned int              threads)
  {
    PreparedStudy prepared;
    prepared.study = read_study(file_name, overrides);
    if (threads > 0)
      prepared.study.threads = threads;
    prepared.runs = plan_runs(prepared.study);
    check_formulas(prepared.study, prepared.runs);
    prepared.parameters = parameters_of(prepared.study, prepared.runs);
    return prepared;
  }


  Outcome
  carry_out(const PreparedStudy &prepared,
            const std::string   &folder,
            const bool           quiet)
  {
    const Study &study = prepared.study;
    prepare_output_directory(folder);
    RunLog log(folder + "/run.log", quiet, true);
    log << (study.title.empty() ? study.name : study.title) << '\n';
    write_atomically(folder + "/used.prm", study.used_parameters);
    catch_signals();
    Runner runner(study, prepared.runs, prepared.parameters, folder);
    carry_out_runs(study, prepared.runs, runner, folder, log);
    return conclude(study, prepared.runs, runner.get_records(), log);
  }


  void
  run_study(const CommandLine &command_line)
  {
    refuse_several_ranks();
    const PreparedStudy prepared = prepare_study(command_line.scene_file,
                                                 command_line.overrides,
                                                 command_line.run.threads);
    if (command_line.run.validate_only)
      {
        std::cout << description_of(prepared.study, prepared.runs)
                  << std::flush;
        return;
      }
    const std::string folder = command_line.run.output_directory.empty()
                                   ? "output/" + prepared.study.name
                                   : command_line.run.output_directory;
    carry_out(prepared, folder, command_line.run.quiet);
  }
} // namespace Morsel::Study
