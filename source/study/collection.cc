#include <morsel/core/atomic_file.h>
#include <morsel/core/build.h>
#include <morsel/core/errors.h>
#include <morsel/core/log.h>
#include <morsel/core/parameters.h>
#include <morsel/core/signals.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/collection.h>
#include <morsel/study/run_study.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

namespace Morsel::Study
{
  namespace fs = std::filesystem;
  using nlohmann::ordered_json;

  namespace
  {
    /// The description of a collection, constant once read.
    struct Collection
    {
      std::string              file;
      std::string              name;
      std::string              title;
      std::string              introduction;
      std::string              parts; ///< files, separated by commas
      bool                     quick = false;
      std::vector<std::string> for_parts; ///< overrides of --set
    };


    void
    declare(Collection &collection, dealii::ParameterHandler &prm)
    {
      prm.add_parameter("Name",
                        collection.name,
                        "Name of the collection and of its folder of results; "
                        "the file's name if empty.");
      prm.add_parameter(
          "Title", collection.title, "Heading of the common report.");
      prm.enter_subsection("Collection");
      prm.add_parameter("Parts",
                        collection.parts,
                        "Files of studies, relative to this file, separated by "
                        "commas.");
      prm.add_parameter("Quick",
                        collection.quick,
                        "Run every part with 'Study/Quick = true'.");
      prm.add_parameter("Introduction",
                        collection.introduction,
                        "Text at the beginning of the common report.");
      prm.leave_subsection();
    }


    std::string
    place_of(const Collection                  &collection,
             const std::vector<ParameterEntry> &entries,
             const std::string                 &path)
    {
      const std::string place = last_place(entries, path);
      return (place.empty() ? collection.file : place) + ": '" + path + "'";
    }


    /// The parts' files as paths from the working folder.
    std::vector<std::string>
    part_files(const Collection                  &collection,
               const std::vector<ParameterEntry> &entries)
    {
      const std::string        path = "Collection/Parts";
      std::vector<std::string> files;
      for (const std::string &item : list_items(collection.parts))
        {
          const std::string full =
              (fs::path(collection.file).parent_path() / item)
                  .lexically_normal()
                  .string();
          std::error_code error;
          if (!fs::is_regular_file(full, error))
            throw InputError(place_of(collection, entries, path) + " has '" +
                             item + "': there is no file '" + full + "'." +
                             did_you_mean(full, files_beside(full)));
          if (!is_study(full))
            throw InputError(place_of(collection, entries, path) + " has '" +
                             item +
                             "', which is no study: it has no section "
                             "'Study'.");
          files.push_back(full);
        }
      if (files.empty())
        throw InputError(place_of(collection, entries, path) +
                         " is empty: list the studies, as in 'figure_1.prm, "
                         "figure_2.prm'.");
      return files;
    }


    struct CollectionReading
    {
      Collection                  collection;
      dealii::ParameterHandler    prm;
      std::vector<ParameterEntry> entries;
    };


    /// Overrides of the section Study are for the parts.
    void
    read(CollectionReading              &reading,
         const std::string              &file_name,
         const std::vector<std::string> &overrides)
    {
      reading.collection.file = file_name;
      reading.entries         = read_parameter_file(file_name);
      for (const std::string &text : overrides)
        {
          const ParameterEntry entry = read_override(text);
          if (entry.section == "Study")
            reading.collection.for_parts.push_back(text);
          else
            reading.entries.push_back(entry);
        }
      declare(reading.collection, reading.prm);
      set_parameters(reading.prm, reading.entries);
      if (reading.collection.name.empty())
        reading.prm.set("Name", fs::path(file_name).stem().string());
    }


    /// With the parts' full paths, so that used.prm means the same wherever it
    /// lies.
    std::string
    used_parameters(CollectionReading              &reading,
                    const std::vector<std::string> &files)
    {
      std::string list;
      for (const std::string &file : files)
        list += (list.empty() ? "" : ", ") + fs::absolute(file).string();
      reading.prm.enter_subsection("Collection");
      reading.prm.set("Parts", list);
      reading.prm.leave_subsection();
      return parameters_as_prm(reading.prm, false);
    }


    /// One study of the collection, and what became of it.
    struct Part
    {
      PreparedStudy prepared;
      std::string   status = "not run";
      std::string   message;
      Outcome       outcome;
      double        wall_time = 0.;
    };


    std::vector<Part>
    prepare_parts(const Collection               &collection,
                  const std::vector<std::string> &files,
                  const unsigned int              threads)
    {
      std::vector<std::string> overrides = collection.for_parts;
      if (collection.quick)
        overrides.emplace_back("Study/Quick=true");
      std::vector<Part>        parts;
      std::vector<std::string> names;
      for (const std::string &file : files)
        {
          Part part;
          part.prepared           = prepare_study(file, overrides, threads);
          const std::string &name = part.prepared.study.name;
          if (std::find(names.begin(), names.end(), name) != names.end())
            throw InputError(collection.file + ": two parts have the name '" +
                             name +
                             "', which is that of their folders; give one of "
                             "them another 'Name'.");
          names.push_back(name);
          parts.push_back(std::move(part));
        }
      return parts;
    }


    void
    write_results(const Collection        &collection,
                  const std::vector<Part> &parts,
                  const std::string       &folder)
    {
      ordered_json list      = ordered_json::array();
      double       wall_time = 0.;
      for (const Part &part : parts)
        {
          const Study &study = part.prepared.study;
          wall_time += part.wall_time;
          list.push_back({{"name", study.name},
                          {"title", study.title},
                          {"file", study.file},
                          {"folder", "parts/" + study.name},
                          {"status", part.status},
                          {"message", part.message},
                          {"runs", part.prepared.runs.size()},
                          {"failed_runs", part.outcome.n_failed},
                          {"wall_time", part.wall_time},
                          {"run_time", part.outcome.run_time}});
        }
      const ordered_json results = {{"name", collection.name},
                                    {"title", collection.title},
                                    {"introduction", collection.introduction},
                                    {"quick", collection.quick},
                                    {"program_version", MORSEL_VERSION},
                                    {"collection", collection.file},
                                    {"wall_time", wall_time},
                                    {"parts", list}};
      write_atomically(folder + "/collection.json", results.dump(2) + "\n");
    }


    void
    carry_out_part(Part &part, const std::string &folder, const bool quiet)
    {
      const dealii::Timer timer;
      try
        {
          part.outcome =
              carry_out(part.prepared,
                        folder + "/parts/" + part.prepared.study.name,
                        quiet);
          part.status = "finished";
        }
      catch (const NumericalError &error)
        {
          part.status           = "failed";
          part.message          = error.what();
          part.outcome.n_failed = part.prepared.runs.size();
        }
      catch (const InputError &error)
        {
          part.status  = "failed";
          part.message = error.what();
        }
      part.wall_time = timer.wall_time();
    }


    std::string
    description_of(const Collection &collection, const std::vector<Part> &parts)
    {
      std::string text =
          "Collection '" + collection.name +
          "' is sound: " + std::to_string(parts.size()) + " studies" +
          (collection.quick ? ", in their quick setting" : "") + ".\n";
      for (const Part &part : parts)
        text += part.prepared.study.name + ": " +
                std::to_string(part.prepared.runs.size()) + " runs\n";
      return text;
    }
  } // namespace


  bool
  is_collection(const std::string &file_name)
  {
    return has_section(file_name, "Collection");
  }


  std::string
  collection_parameters(const std::string              &format,
                        const std::string              &file_name,
                        const std::vector<std::string> &overrides)
  {
    CollectionReading reading;
    read(reading, file_name, overrides);
    if (format == "json")
      return parameters_as_json(reading.prm);
    return format == "md" ? parameters_as_markdown(reading.prm)
                          : parameters_as_prm(reading.prm, true);
  }


  void
  run_collection(const CommandLine &command_line)
  {
    refuse_several_ranks();
    CollectionReading reading;
    read(reading, command_line.scene_file, command_line.overrides);
    const Collection              &collection = reading.collection;
    const std::vector<std::string> files =
        part_files(collection, reading.entries);
    std::vector<Part> parts =
        prepare_parts(collection, files, command_line.run.threads);
    if (command_line.run.validate_only)
      {
        std::cout << description_of(collection, parts) << std::flush;
        return;
      }

    const std::string folder = command_line.run.output_directory.empty()
                                   ? "output/" + collection.name
                                   : command_line.run.output_directory;
    prepare_output_directory(folder);
    RunLog log(folder + "/run.log", command_line.run.quiet, true);
    log << (collection.title.empty() ? collection.name : collection.title)
        << '\n';
    write_atomically(folder + "/used.prm", used_parameters(reading, files));
    write_results(collection, parts, folder);
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        log << "Part " << p + 1 << " of " << parts.size() << ": "
            << parts[p].prepared.study.name << std::endl;
        carry_out_part(parts[p], folder, command_line.run.quiet);
        write_results(collection, parts, folder);
        log << parts[p].prepared.study.name << ' ' << parts[p].status
            << " after " << number_text(parts[p].wall_time) << " s "
            << parts[p].message << std::endl;
      }
    if (std::all_of(parts.begin(), parts.end(), [](const Part &part) {
          return part.status == "failed";
        }))
      throw NumericalError("No study of the collection finished; the first one "
                           "said: " +
                           parts.front().message);
  }
} // namespace Morsel::Study
